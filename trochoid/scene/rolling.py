"""A rolling bearing as a table of the scene: by its boundary dimensions, its inner geometry, or both; and its seat."""

from __future__ import annotations

from typing import Annotated, Literal, TypeVar

from pydantic import model_validator

from trochoid.scene import units
from trochoid.scene.fields import Boolean, Length, Measure, PositiveLength, Table, Whole, fault

Elements = Annotated[int, Whole(3, 200)]
ContactAngle = Annotated[float, Measure(units.ANGLE, least=0.0, below=90.0)]
Groove = Annotated[float, Measure(units.NUMBER, above=0.0, most=1.0)]
Load = Annotated[float, Measure(units.FORCE, above=0.0)]
AxialLoad = Annotated[float, Measure(units.FORCE, least=0.0)]
ViscosityRatio = Annotated[float, Measure(units.NUMBER, least=0.1, most=100.0)]
Contamination = Annotated[float, Measure(units.NUMBER, above=0.0, most=1.0)]
SupportAngle = Annotated[float, Measure(units.ANGLE, above=0.0, most=180.0)]
BearingKind = Literal["deep_groove", "angular_contact", "cylindrical", "needle", "tapered"]

BALLS: tuple[str, ...] = ("deep_groove", "angular_contact")
PLAIN: tuple[str, ...] = (
    "cylindrical",
    "needle",
)  # they press their seat along its radii, alike over their length
ONE_SIDED: tuple[str, ...] = ("angular_contact", "tapered")
LEAST_LOAD = 1e-3  # N: less is no load
INNER_GROOVE, OUTER_GROOVE = 0.52, 0.53  # radii over the ball diameter: those of ISO 281


class Seat(Table):
    """[… .seat]: the housing around the outer ring, a round wall that is held at some places of its outer edge."""

    thickness: PositiveLength
    width: PositiveLength | None = None
    material: str = "steel"
    supports: Annotated[int, Whole(0, 36)] = 4
    support_angle: SupportAngle = units.ANGLE.to_si(20.0)

    @model_validator(mode="after")
    def _apart(self) -> Seat:
        whole = self.supports * units.ANGLE.from_si(self.support_angle)
        if whole >= 360.0:
            raise fault(
                f"{self.supports} supports of {units.ANGLE.from_si(self.support_angle):g} deg meet; give supports = 0 "
                f"for an edge that is held all round, or a support_angle below {360.0 / self.supports:g} deg"
            )
        return self


class RollingTable(Table):
    """What a rolling bearing is made of, what it carries, and what its life depends on; of no `kind` it is none."""

    kind: BearingKind | None = None
    bore: PositiveLength | None = None
    outside: PositiveLength | None = None
    width: PositiveLength | None = None
    clearance: Length = 0.0
    contact_angle: ContactAngle | None = None
    elements: Elements | None = None
    element_diameter: PositiveLength | None = None
    element_length: PositiveLength | None = None
    pitch_diameter: PositiveLength | None = None
    inner_groove: Groove = INNER_GROOVE
    outer_groove: Groove = OUTER_GROOVE
    straight_rollers: Boolean = False
    radial_load: Load | None = None
    axial_load: AxialLoad = 0.0
    centrifugal: Boolean = False
    dynamic_rating: Load | None = None
    viscosity_ratio: ViscosityRatio | None = None
    fatigue_load: Load | None = None
    contamination: Contamination = 0.5
    seat: Seat | None = None

    @model_validator(mode="after")
    def _can_be_built(self) -> RollingTable:
        if self.kind is not None:
            _fail_if_unsized(self)
            _fail_if_foreign(self)
            _fail_if_misfit(self)
            _fail_if_seat_is_foreign(self)
        return self


class RollingBearing(RollingTable):
    """[… .bearing]: a rolling bearing in the place of a stiffness."""

    kind: BearingKind


HeldT = TypeVar("HeldT", bound=Table)


def has_a_stiffness(table: HeldT) -> HeldT:
    """Refuse a member on bearings of which neither `bearing_stiffness` nor `bearing` is given."""
    if getattr(table, "bearing_stiffness", None) is None and getattr(table, "bearing", None) is None:
        raise fault(
            "no stiffness of its bearings; need bearing_stiffness, or a rolling bearing: the table bearing"
        )
    return table


def _fail_if_unsized(table: RollingTable) -> None:
    sizes = {"bore": table.bore, "outside": table.outside, "width": table.width}
    absent = [name for name, size in sizes.items() if size is None]
    inner = {name: getattr(table, name) for name in inner_geometry(table.kind)}
    missing = [name for name, size in inner.items() if size is None]
    if absent and missing:
        raise fault(
            f'kind = "{table.kind}" needs {", ".join(absent)} too, or for an inner geometry of its own '
            f"{', '.join(missing)}"
        )
    if table.bore is not None and table.outside is not None and not table.outside > table.bore:
        raise fault(
            f"given outside = {1e3 * table.outside:g} mm; need more than bore = {1e3 * table.bore:g} mm"
        )
    if table.kind in ONE_SIDED and table.axial_load == 0.0:
        raise fault(f'kind = "{table.kind}" carries nothing without an axial load; give axial_load above 0 N')


def inner_geometry(kind: str | None) -> tuple[str, ...]:
    """Return the fields that together stand for boundary dimensions."""
    both = ("elements", "element_diameter", "pitch_diameter")
    return both if kind in BALLS else (*both, "element_length")


def _fail_if_foreign(table: RollingTable) -> None:
    given = {
        "element_length": table.element_length is not None and table.kind in BALLS,
        "straight_rollers": table.straight_rollers and table.kind in BALLS,
        "contact_angle": bool(table.contact_angle) and table.kind not in ONE_SIDED,
        "inner_groove": table.inner_groove != INNER_GROOVE and table.kind not in BALLS,
        "outer_groove": table.outer_groove != OUTER_GROOVE and table.kind not in BALLS,
        "axial_load": table.axial_load != 0.0 and table.kind in PLAIN,
        "centrifugal": table.centrifugal and table.kind not in BALLS,
    }
    foreign = [name for name, is_given in given.items() if is_given]
    if foreign:
        raise fault(f'kind = "{table.kind}" has no {", ".join(foreign)}; take it away, or give another kind')
    if table.radial_load is not None and table.radial_load < LEAST_LOAD:
        raise fault(f"given radial_load = {table.radial_load:g} N; need {LEAST_LOAD:g} N or more")
    if (table.viscosity_ratio is None) != (table.fatigue_load is None):
        one, other = ("viscosity_ratio", "fatigue_load")[:: 1 if table.fatigue_load is None else -1]
        raise fault(f"{one} needs {other} too: the modified life follows from both")


def _fail_if_misfit(table: RollingTable) -> None:
    for name in ("inner_groove", "outer_groove"):
        groove = getattr(table, name)
        if not groove > 0.5:
            raise fault(
                f"{name} = {groove:g} ball diameters: no ball of half a diameter's radius fits such a groove; need "
                f"more than 0.5 (0.52 is usual)"
            )
    if table.pitch_diameter is None:
        return
    low, high = table.bore or 0.0, table.outside or float("inf")
    if not low < table.pitch_diameter < high:
        raise fault(
            f"pitch_diameter = {1e3 * table.pitch_diameter:g} mm; need a value between bore = {1e3 * low:g} mm and "
            f"outside = {1e3 * high:g} mm"
        )


def _fail_if_seat_is_foreign(table: RollingTable) -> None:
    if table.seat is None:
        return
    if table.kind not in PLAIN:
        raise fault(
            f'kind = "{table.kind}" with a seat: it presses its housing at points or askew, which a plane ring does '
            f"not tell; seats serve cylindrical and needle bearings"
        )
    absent = [name for name in ("outside", "width") if getattr(table, name) is None]
    if absent:
        raise fault(f"the seat needs {', '.join(absent)} too: the outer ring is part of it")

"""Curves put into rows: what shares axis, unit and kind stands together, a crowd is spread over several."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from trochoid.report.curves import Curve
from trochoid.report.units import DisplayUnit, axis_unit, display_unit

_CROWD = 12  # curves in one row before they are spread over several


@dataclass(frozen=True, slots=True)
class Panel:
    """One row of a figure: curves over one axis in one unit; `title` names the place that they share."""

    curves: tuple[Curve, ...]
    title: str = ""

    @property
    def first(self) -> Curve:
        """The curve that speaks for all where they agree."""
        return self.curves[0]

    @property
    def heat(self) -> bool:
        """Whether the row is a map of angle and index."""
        return self.first.heat

    @property
    def largest(self) -> float:
        """Largest magnitude of all curves."""
        return max(curve.largest for curve in self.curves)

    @property
    def unit(self) -> DisplayUnit:
        """Unit of the values."""
        return display_unit(self.first.units, self.largest)

    @property
    def x_unit(self) -> DisplayUnit:
        """Unit of the axis."""
        return axis_unit(self.first.x_units)

    @property
    def variables(self) -> list[str]:
        """Names of the variables, each once."""
        return list(dict.fromkeys(curve.variable for curve in self.curves))

    @property
    def subject(self) -> str:
        """Return what the row shows: "reaction" of "reaction, rigid" and "reaction, elastic"."""
        if len(self.variables) == 1:
            return self.variables[0]
        heads = {name.split(",")[0] for name in self.variables}
        return heads.pop() if len(heads) == 1 else ""

    def name(self, curve: Curve) -> str:
        """Return the name of a curve, without what the row's title and subject already say."""
        told = self.title.split(" · ")
        place = " · ".join(entry for entry in curve.place.values() if entry not in told)
        own = curve.variable.removeprefix(self.subject).strip(" ,") if len(self.variables) > 1 else ""
        return " · ".join(filter(None, (own, place))) or curve.variable


def panels_of(curves: Sequence[Curve]) -> list[Panel]:
    """Return the rows in which to draw `curves`."""
    kinds: dict[tuple[str, str, bool, bool], list[Curve]] = {}
    for curve in curves:
        kinds.setdefault((curve.x_dim, curve.units, curve.heat, curve.log), []).append(curve)
    rows: list[Panel] = []
    for alike in kinds.values():
        rows.extend(_spread(alike) if len(alike) > _CROWD or alike[0].heat else [Panel(tuple(alike))])
    return rows


def _spread(curves: Sequence[Curve]) -> list[Panel]:
    """Return a row per place on the shortest dimension; for maps, per place on all but the longest."""
    heat = curves[0].heat
    entries: dict[str, set[str]] = {}
    for curve in curves:
        for dim, entry in curve.place.items():
            entries.setdefault(dim, set()).add(entry)
    by_size = sorted(entries, key=lambda dim: len(entries[dim]))
    apart = by_size[:-1] if heat else by_size[:1] if len(by_size) > 1 else []
    rows: dict[tuple[str, ...], list[Curve]] = {}
    for curve in curves:
        place = tuple(curve.place[dim] for dim in apart if dim in curve.place)
        rows.setdefault((curve.variable if heat else "", *place), []).append(curve)
    return [Panel(tuple(row), " · ".join(place)) for (_, *place), row in rows.items()]

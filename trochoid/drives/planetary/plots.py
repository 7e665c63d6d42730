"""Pictures: the load along the paths of contact; blocking contours in both planes and in space."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np

from trochoid.drives.planetary.stages import Stages
from trochoid.geometry.blocking_contour import Contour
from trochoid.geometry.blocking_surface import surface
from trochoid.kinematics.types import Array, frozen
from trochoid.results.plot import Axis, Plot, PlotCurve, PlotSurface

LINE, OWN, BEST = "coaxial shifts", "this set", "best shifts"
AXES = (Axis("shift of the sun x₁"), Axis("shift of the planets x₂"), Axis("shift of the ring x₃"))


def plots(stages: Stages, ran: Collection[str]) -> tuple[Plot, ...]:
    """Return what the stages "contact" and "blocking" have pictures of, if they `ran`."""
    found: tuple[Plot, ...] = (_along_the_path(stages),) if "contact" in ran else ()
    if "modes" in ran:
        from trochoid.drives.planetary.modes import campbell

        found = (*found, campbell(stages.moving.fine, stages.scene.operation.input_speed))
    return (*found, *contours(stages)) if "blocking" in ran else found


def _along_the_path(stages: Stages) -> Plot:
    """Return the force on a pair of teeth on its way through the mesh, for each planet."""
    series, curves = stages.contact.fine, []
    for name, touches, pair in (("sun", series.sun, 0), ("ring", series.ring, 1)):
        wheel = stages.contact.level.wheels[pair].flank
        rho = np.sqrt(2.0 * wheel.base_radius * np.maximum(touches.place, 0.0))
        mesh = (stages.feasible.geometry.outer, stages.feasible.geometry.inner)[pair]
        pole = float(mesh.pitch_radii[0]) * np.sin(float(mesh.operating_angle))
        for i in range(touches.force.shape[1]):
            pressed = touches.force[:, i] > 0.0
            points = np.stack([rho[:, i][pressed] - pole, touches.force[:, i][pressed]], axis=-1)
            points = points[np.argsort(points[:, 0])]
            curves.append(PlotCurve(f"planet {i + 1}, {name}", frozen(points), f"planet {i + 1}, {name}"))
    return Plot(
        "Load along the paths of contact",
        (Axis("distance from the pitch point", "m"), Axis("force on a pair of teeth", "N")),
        tuple(curves),
        caption=(
            "From the root of the sun (of the planet, in the ring) towards its tip; where one pair is alone it has all."
        ),
        equal=False,
    )


def contours(stages: Stages) -> tuple[Plot, ...]:
    """Return the plane contours and the body."""
    found = stages.blocking
    inside = "Inside all conditions hold; each part of the boundary bears the name of the condition that ends there."
    return (
        Plot(
            "Blocking contour of sun and planet",
            AXES[:2],
            (*_boundary(found.outer), *_points(stages, (0, 1))),
            caption=f"{inside} Area {found.outer.area:.4g}. On the line, centre distance and shifts go together.",
            equal=False,
        ),
        Plot(
            "Blocking contour of planet and ring",
            AXES[1:],
            (*_boundary(found.inner), *_points(stages, (1, 2))),
            caption=f"{inside} Area {found.inner.area:.4g}.",
            equal=False,
        ),
        Plot(
            "Blocking contour of the whole set",
            AXES,
            tuple(_points(stages, (0, 1, 2))),
            tuple(
                PlotSurface(face.name, face.vertices, face.triangles, 0.6, face.name)
                for face in surface(found.outer, found.inner)
            ),
            caption=f"What both contours allow, volume {found.volume:.4g}, and the line of coaxial shifts through it.",
            equal=False,
        ),
    )


def _boundary(contour: Contour) -> Iterator[PlotCurve]:
    """Yield the parts of a contour's boundary, a condition each."""
    for boundary in contour.boundaries:
        n, label = len(boundary.points), boundary.conditions
        starts = np.flatnonzero(label != np.roll(label, 1))
        if not starts.size:
            starts = np.array([0])
        for begin, end in zip(starts, [*starts[1:], starts[0] + n], strict=True):
            points = boundary.points[np.arange(begin, end + 1) % n]
            name = contour.names[label[begin]]
            yield PlotCurve(name, _thinned(points), name)


def _points(stages: Stages, axes: tuple[int, ...]) -> Iterator[PlotCurve]:
    """Yield the line's feasible stretches, the set's own shifts and the best ones in these axes."""
    found = stages.blocking
    for stretch in found.line.stretches:
        ends = _picked([found.line.shifts(x) for x in (stretch.low, stretch.high)], axes)
        names = (f"lower end: {stretch.low_condition}", f"upper end: {stretch.high_condition}")
        labels = tuple(f"{name}, {_said(at)}" for name, at in zip(names, ends, strict=True))
        yield PlotCurve(LINE, ends, LINE, labels=labels)
    own = _picked([stages.feasible.given.shifts], axes)
    yield PlotCurve(OWN, own, OWN, "points", labels=(f"this set, {_said(own[0])}",))
    if found.best:
        best = _picked([choice.shifts for choice in found.best.values()], axes)
        said = tuple(
            f"{name.replace('_', ' ')}, {_said(at)}" for name, at in zip(found.best, best, strict=True)
        )
        yield PlotCurve(BEST, best, BEST, "points", labels=said)


def _picked(shifts: list[tuple[float, float, float]], axes: tuple[int, ...]) -> Array:
    return frozen(np.array(shifts, dtype=np.float64)[:, axes])


def _said(shifts: Array) -> str:
    return " / ".join(f"{x:.4g}" for x in shifts)


def _thinned(points: Array, most: int = 200) -> Array:
    """A polyline with fewer points, its ends among them."""
    keep = np.unique(np.linspace(0, len(points) - 1, min(most, len(points))).round().astype(int))
    return frozen(points[keep])

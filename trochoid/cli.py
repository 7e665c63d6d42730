"""The command line; what goes wrong ends in clear lines and exit code 1 (the job) or 2 (what was written)."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

import click

from trochoid import console
from trochoid.kinematics.errors import SceneError, TrochoidError

if TYPE_CHECKING:
    from trochoid.plan import Plan
    from trochoid.scene import Scene

FAILED, WRONG = 1, 2


class _Place(click.Path):
    """A path with a name: an empty text, such as an unset variable's, is not the current folder."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            self.fail("is empty; give a name, or leave the option out", param, ctx)
        return super().convert(value, param, ctx)


_OUT = click.option(
    "--out",
    type=_Place(path_type=Path),
    metavar="DIR",
    help="Where results go.  [default: out/NAME of the scene]",
)
_SET = click.option(
    "--set",
    "overrides",
    multiple=True,
    metavar="KEY=VALUE",
    help="Replace one value of the scene: drive.pins=24. Repeatable.",
)
_ASK = click.option("--ask", metavar="Q1,Q2", help="Compute these quantities instead of those of the scene.")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line (sys.argv by default) and return its exit code; nothing but a code ever leaves."""
    console.one_thread()
    try:
        with (
            console.stoppable(),
            commands.make_context("trochoid", [*(sys.argv[1:] if argv is None else argv)]) as ctx,
        ):
            commands.invoke(ctx)
            console.flush()
        return 0
    except click.exceptions.Exit as done:
        return done.exit_code
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except SceneError as error:
        return _say(str(error), WRONG)
    except TrochoidError as error:
        return _say("\n".join(f"trochoid: {line}" for line in str(error).splitlines()), FAILED)
    except (KeyboardInterrupt, click.Abort):
        return _say("trochoid: interrupted; previous results are untouched", FAILED)
    except BrokenPipeError:
        console.forget_stdout()
        return FAILED
    except OSError as error:
        console.forget_stdout()
        return _say(
            f"trochoid: {error.strerror or error}{f': {error.filename}' if error.filename else ''}", FAILED
        )
    except MemoryError:
        return _say(
            "trochoid: out of memory; ask for fewer positions, or set a larger accuracy.tolerance", FAILED
        )
    except Exception as error:
        return _say(console.defect(error), FAILED)


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="trochoid", message="%(prog)s %(version)s")
def commands() -> None:
    """Eccentric and planetary gear drives: profiles, elastic contact, stiffness, reactions, vibration.

    \b
    trochoid new khv > scene.toml    start from a commented scene
    trochoid check scene.toml        see what a run would do
    trochoid run scene.toml          compute: tables, report.html, VTK files
    trochoid accuracy scene.toml     measure error against seconds, model by model
    """


@commands.command()
@click.argument("kind")
def new(kind: str) -> None:
    """Print a commented starter scene.

    \b
    KIND is the kind of drive:
    khv            planetary-cycloid reducer
    rv             2K-V: involute stage, crankshafts, cycloid discs
    planetary      involute 2K-H: sun, planets, ring, carrier
    precessional   nutating satellite with sphere teeth
    indexer        spherical planetary-pin indexer
    """
    from trochoid.starter import starter

    click.echo(starter(kind), nl=False)


@commands.command()
@click.argument("scene")
@_SET
@_ASK
def check(scene: str, overrides: tuple[str, ...], ask: str | None) -> None:
    """Check SCENE and print the plan; solve nothing."""
    loaded = _load(scene, overrides, ask)
    from trochoid.run import plan

    click.echo(_plan_text(scene, plan(loaded)))


@commands.command()
@click.argument("scene")
@_OUT
@_SET
@_ASK
@click.option(
    "--json",
    "as_json",
    is_flag=True,
    help="Print results.json instead of tables; write files only with --out.",
)
def run(scene: str, out: Path | None, overrides: tuple[str, ...], ask: str | None, as_json: bool) -> None:
    """Compute what SCENE asks for.

    \b
    trochoid run scene.toml --set drive.pins=24 --set "drive.pin_radius=0.2 in"
    trochoid run scene.toml --ask ratio,mass --json
    """
    loaded = _load(scene, overrides, ask)
    folder = _folder(scene, out, as_json)
    from trochoid import results
    from trochoid.clock import Clock
    from trochoid.run import Run

    if folder is not None:
        results.prepare(folder)
    with console.progress() as announce:
        outcome = Run(loaded, Clock(announce)).outcome
        files = () if folder is None else results.write(outcome, folder)
    if as_json:
        click.echo(results.to_json(outcome), nl=False)
    else:
        results.show(outcome, files)


@commands.command()
@click.argument("scene")
@_OUT
@_SET
@_ASK
@click.option(
    "--budget",
    type=click.FloatRange(min=0, min_open=True),
    default=60.0,
    show_default=True,
    metavar="SECONDS",
    help="Stop refining the mesh when the next level would take longer.",
)
@click.option("--resolved", is_flag=True, help="Check one position by fully resolved finite elements (slow).")
@click.option(
    "--json", "as_json", is_flag=True, help="Print accuracy.json instead; write files only with --out."
)
def accuracy(
    scene: str,
    out: Path | None,
    overrides: tuple[str, ...],
    ask: str | None,
    budget: float,
    resolved: bool,
    as_json: bool,
) -> None:
    """Measure what accuracy costs in SCENE: error against seconds, model by model, mesh by mesh.

    \b
    trochoid accuracy scene.toml --ask torsional_stiffness,contact_force_max
    trochoid accuracy scene.toml --budget 300 --resolved
    """
    loaded = _load(scene, overrides, ask)
    folder = _folder(scene, out, as_json)
    from trochoid import accuracy, results

    if folder is not None:
        results.prepare(folder)
    with console.progress() as announce:
        found = accuracy.study(loaded, budget, announce, oracle=resolved)
        files = () if folder is None else accuracy.write(found, folder)
    if as_json:
        click.echo(accuracy.to_json(found), nl=False)
    else:
        accuracy.show(found, files)


@commands.command()
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option("--film", metavar="NAME", help="Which film; by default the first. A wrong name lists them.")
@click.option("--frame", type=int, metavar="N", help="Frame to begin with, from 0.")
@click.option(
    "--at", type=float, metavar="VALUE", help="Begin with the frame nearest this value, angles in deg."
)
@click.option("--show", metavar="DATA", help="Colour bodies by this point data, in place of the film's own.")
@click.option(
    "--screenshot", type=click.Path(path_type=Path), metavar="FILE", help="Save a picture and open no window."
)
@click.option(
    "--movie", type=click.Path(path_type=Path), metavar="FILE.gif", help="Save all frames as an animation."
)
def view(
    folder: Path,
    film: str | None,
    frame: int | None,
    at: float | None,
    show: str | None,
    screenshot: Path | None,
    movie: Path | None,
) -> None:
    """Show the films of a run in DIR: bodies in space, deformed, with stress and pressure.

    \b
    trochoid view out/precessional
    trochoid view out/precessional --at 120 --screenshot picture.png
    """
    from trochoid.view import Wanted
    from trochoid.view import view as open_film

    click.echo(open_film(folder, wanted=Wanted(film, frame, at, show, screenshot, movie)))


@commands.command()
@click.argument("scene")
@click.option(
    "--to",
    "target",
    type=_Place(path_type=Path),
    required=True,
    metavar="FILE",
    help="Its ending says what.",
)
@_SET
def export(scene: str, target: Path, overrides: tuple[str, ...]) -> None:
    """Write exact shapes of SCENE for other programs, by the ending of FILE; a wrong one lists those of the kind.

    \b
    trochoid export scene.toml --to rim.step    solids of a precessional drive or an indexer
    trochoid export scene.toml --to flank.csv   points of the profiles
    """
    from trochoid.export import export as write

    said = write(_load(scene, overrides, None), target)
    click.echo(f"wrote {target}: {said}")


def _folder(scene: str, out: Path | None, as_json: bool) -> Path | None:
    """Return where files go; None for nowhere."""
    return None if as_json and out is None else out or Path("out") / (Path(scene).stem or "scene")


def _load(path: str, overrides: Sequence[str], ask: str | None) -> Scene[Any]:
    from trochoid.scene import Override, load

    asked: list[str | Override] = []
    if ask is not None:
        names = [name.strip() for name in ask.split(",") if name.strip()]
        asked = [Override(("ask", "quantities"), names, f"--ask {ask}")]
    return load(path, [*overrides, *asked])


def _plan_text(path: str, plan: Plan) -> str:
    """Return a plan as aligned lines: quantities, effects, the stages with their costs."""
    rows = [("stage", "seconds", "MiB", "why")]
    rows += [
        (s.name, _short(s.seconds), f"{s.memory_mib:.0f}", s.why) if s.needed else (s.name, "-", "-", s.why)
        for s in plan.stages
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    needed = [stage for stage in plan.stages if stage.needed]
    total = sum(stage.seconds for stage in needed)
    memory = max((stage.memory_mib for stage in needed), default=0.0)
    lines = [
        f"{path} is valid",
        _wrapped("quantities", plan.quantities),
        _wrapped("effects", plan.effects or ("none",)),
        f"model       {plan.model}",
        f"geometry    {'feasible' if any(s.name == 'geometry' for s in needed) else 'not needed'}",
        "",
        *(f"{a:<{widths[0]}}  {b:>{widths[1]}}  {c:>{widths[2]}}  {why}".rstrip() for a, b, c, why in rows),
        "",
        f"about {_lasting(total)} and {_large(memory)}",
    ]
    return "\n".join(lines)


def _short(seconds: float) -> str:
    return f"{seconds:.2g}" if seconds < 100.0 else f"{seconds:.0f}"


def _lasting(seconds: float) -> str:
    """Return a span of time in the unit that suits it."""
    for unit, size in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{_short(seconds)} s"


def _large(mib: float) -> str:
    return f"{mib:.0f} MiB" if mib < 10240.0 else f"{mib / 1024.0:.0f} GiB"


def _wrapped(head: str, names: Sequence[str]) -> str:
    return fill(f"{head:<12}{', '.join(names)}", 100, subsequent_indent=" " * 12, break_on_hyphens=False)


def _say(message: str, code: int) -> int:
    with suppress(BrokenPipeError):
        click.echo(message, err=True)
    return code

"""Curves and sweeps of any problem in plain Python."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING

from microslip.errors import GivenError
from microslip.experiments import HERTZ, LONGEST, Curve, March, check_samples
from microslip.function_arguments import check_apart, checked, named, read, texts_of
from microslip.quantity import quantity

if TYPE_CHECKING:
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.response_curve import ResponseCurve
    from microslip_mechanics.time_history import TimeHistory


REMEDY = (
    "give a longer time_step, a larger store_every, a shorter duration or ramp, or "
    "lower frequencies"
)


@dataclass(frozen=True, slots=True)
class Swept:
    """The swept sine of :func:`sweep`."""

    lowest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    highest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    duration: float = quantity("s", positive=True, highest=LONGEST)
    ramp: float = quantity("s", lowest=0.0, highest=LONGEST)


def scene(source: str | PathLike[str], overrides: Sequence[str] = ()) -> Problem:
    """Return the problem of a built-in scene, or of a scene file.

    Parameters
    ----------
    source
        Name or path.
    overrides
        Texts ``table.key=value`` that replace values, or one of them.

    Raises
    ------
    SceneError
        With file, table, key, value and remedy.
    """
    from microslip.rigs import problem_of
    from microslip.scene_file import load_scene

    several = texts_of("microslip.scene", source, overrides)
    return problem_of(load_scene(str(source), several))


def curve(
    problem: Problem,
    lowest: float | str,
    highest: float | str,
    *,
    tolerance: float | None = None,
    harmonics: int | None = None,
    samples: int | None = None,
) -> ResponseCurve:
    """Return the frequency response curve by harmonic balance, as far as it goes.

    Parameters
    ----------
    problem
        From :func:`microslip.system` or :func:`microslip.scene`.
    lowest, highest
        Where it begins and ends [Hz]; downwards if the first is the larger one. These
        and other quantities may be texts with a unit, such as ``"0.1 kHz"``.
    tolerance
        Relative error of amplitude, from which harmonics and samples follow; 1e-3 if
        left out.
    harmonics, samples
        Fixed numbers instead.

    Raises
    ------
    MicroslipError
        If an argument is of no use, or if there is not even a first point; else
        ``ending`` says how the curve ends.
    """
    from microslip.studies.curve import trace_curve

    name = "microslip.curve"
    if tolerance is not None and harmonics is not None:
        raise GivenError(
            f"{name}: tolerance = {tolerance!r}: harmonics are fixed: leave one of "
            "them out"
        )
    wanted: Curve = read(
        name,
        Curve,
        lowest=lowest,
        highest=highest,
        tolerance=tolerance,
        harmonics=harmonics,
        samples=samples,
    )
    check_samples(f"{name}:", wanted)
    check_apart(name, wanted.lowest, wanted.highest)
    given = checked(name, problem)
    with named(name):
        return trace_curve(given, wanted).curve


def sweep(
    problem: Problem,
    lowest: float | str,
    highest: float | str,
    *,
    duration: float | str,
    time_step: float | str,
    ramp: float | str = 0.0,
    store_every: int = 1,
) -> TimeHistory:
    """Return the march through an exponential swept sine.

    Parameters
    ----------
    problem
        From :func:`microslip.system` or :func:`microslip.scene`.
    lowest, highest
        Frequency at the start and at the end of the sweep [Hz].
    duration
        Of the sweep, after the ramp [s].
    time_step
        [s]
    ramp
        Time in which the preload grows before the sweep [s].
    store_every
        Steps per stored time.

    Raises
    ------
    MicroslipError
        If an argument is of no use, or if the first steps fail; else ``ending`` says
        how the march ends.
    """
    from microslip.studies.march_size import demand_end
    from microslip.studies.sweep import march_sweep
    from microslip_mechanics.excitation import SweptSine
    from timedomain.options import MarchOptions

    name = "microslip.sweep"
    march: March = read(name, March, time_step=time_step, store_every=store_every)
    swept: Swept = read(
        name, Swept, lowest=lowest, highest=highest, duration=duration, ramp=ramp
    )
    check_apart(name, swept.lowest, swept.highest)
    begin, end = swept.ramp, swept.ramp + swept.duration
    history = SweptSine(begin, begin, end, end, swept.lowest, swept.highest)
    given = checked(name, problem)
    with named(name):
        demand_end(history, MarchOptions(march.time_step, march.store_every), REMEDY)
        return march_sweep(given, history, march)

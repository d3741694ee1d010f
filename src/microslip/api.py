"""Curves and sweeps of any problem in plain Python."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from microslip.experiments import Curve, March

if TYPE_CHECKING:
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.response import ResponseCurve
    from microslip_mechanics.time_history import TimeHistory


def scene(source: str, overrides: Sequence[str] = ()) -> Problem:
    """Return the problem of a built-in scene, or of a scene file.

    Parameters
    ----------
    source
        Name or path.
    overrides
        Texts ``table.key=value`` that replace values.

    Raises
    ------
    SceneError
        With file, table, key, value and remedy.
    """
    from microslip.rigs import problem_of
    from microslip.scene_file import load_scene

    return problem_of(load_scene(source, overrides))


def curve(
    problem: Problem,
    lowest: float,
    highest: float,
    *,
    tolerance: float = 1e-3,
    harmonics: int | None = None,
    samples: int | None = None,
) -> ResponseCurve:
    """Return the frequency response curve by harmonic balance, as far as it goes.

    Parameters
    ----------
    problem
        From :func:`microslip.system` or :func:`microslip.scene`.
    lowest, highest
        Where it begins and ends [Hz]; downwards if the first is the larger one.
    tolerance
        Relative error of amplitude, from which harmonics and samples follow.
    harmonics, samples
        Fixed numbers instead.

    Raises
    ------
    MicroslipError
        If there is not even a first point; else ``ending`` says how the curve ends.
    """
    from microslip.studies.curve import trace_curve

    wanted = Curve(lowest, highest, tolerance, harmonics, samples)
    return trace_curve(problem, wanted).curve


def sweep(
    problem: Problem,
    lowest: float,
    highest: float,
    *,
    duration: float,
    time_step: float,
    ramp: float = 0.0,
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
        If the first steps fail; else ``ending`` says how the march ends.
    """
    from microslip.studies.sweep import march_sweep
    from microslip_mechanics.excitation import SweptSine

    end = ramp + duration
    history = SweptSine(ramp, ramp, end, end, lowest, highest)
    return march_sweep(problem, history, March(time_step, store_every))

"""The swept sine of a scene, as far as it was marched."""

from __future__ import annotations

from microslip.progress import Watch
from microslip.scene_file import March, Sweep
from microslip_mechanics.excitation import SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.time_history import TimeHistory, joined
from timedomain.integrate import IntegrationError, MarchOptions, integrate


def march_sweep(
    problem: Problem, sweep: SweptSine, march: March, watch: Watch = iter
) -> TimeHistory:
    """March a sweep; keep what there is when it cannot go on or is stopped."""
    options = MarchOptions(march.time_step, march.store_every)
    blocks: list[TimeHistory] = []
    ending = "complete"
    try:
        for block in watch(integrate(problem, sweep, options)):
            blocks.append(block)  # noqa: PERF402  (what is there must be kept)
    except IntegrationError as error:
        ending = str(error)
        if not blocks:
            raise
    except KeyboardInterrupt:
        ending = "interrupted"
        if not blocks:
            raise
    return joined(blocks, ending)


def march_whole(
    problem: Problem, sweep: SweptSine, march: March, watch: Watch = iter
) -> TimeHistory:
    """March a sweep to its end, or raise: a part of it would give wrong energies."""
    history = march_sweep(problem, sweep, march, watch)
    if history.ending == "interrupted":
        raise KeyboardInterrupt
    if history.ending != "complete":
        raise IntegrationError(history.ending)
    return history


def swept_sine(sweep: Sweep, *, slower: float = 1.0) -> SweptSine:
    """Return a scene's upward exponential sweep, made ``slower`` times as long."""
    longer = (slower - 1.0) * (sweep.end - sweep.start)
    return SweptSine(
        sweep.ramp,
        sweep.start,
        sweep.end + longer,
        sweep.duration + longer,
        sweep.lowest,
        sweep.highest,
    )

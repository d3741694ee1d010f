"""Changes of stability: where few harmonics mislead, and how far aside they may lie."""

import itertools
import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
import pytest

from hbm.continuation.segment import ROUGH
from hbm.events import crossings
from hbm.events.crossings import Crossing, Crossings
from hbm.events.finer_orbits import FinerOrbits
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import between_stops

HERTZ = 2.0 * math.pi


@pytest.mark.parametrize(("lowest", "highest"), [(1.64, 1.70), (2.25, 2.30)])
def test_a_mass_between_stops_has_a_branch_point_where_its_stability_changes(
    lowest: float, highest: float
) -> None:
    # Two multipliers meet on the real axis a hair's breadth from there: those of orbits
    # with half the harmonics do so at another frequency.
    problem = between_stops()
    rest = static_equilibrium(problem)
    options = CurveOptions(lowest * HERTZ, highest * HERTZ)

    curve = list(until_restart(frequency_response(problem, rest, options)))
    (told,) = (each for each in curve if each.event)
    others = [each for each in curve if each is not told]
    below, above = (
        {each.unstable for each in others if (each.frequency > told.frequency) is side}
        for side in (False, True)
    )

    assert told.event == "branch point"
    assert np.abs(told.multipliers - 1.0).min() < 1e-3
    assert sorted([*below, *above]) == [0, 1]


def test_orbits_that_are_not_to_be_had_are_not_sought_at_every_place(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = between_stops()
    finest, asked = FourierBasis(255, 2048), list[FourierBasis]()
    between = Crossings.between

    def lost(*arguments: Any) -> None:
        asked.append(arguments[-1])

    def without(*arguments: Any) -> Iterator[Crossing]:
        with monkeypatch.context() as patch:
            patch.setattr(FinerOrbits, "finer", lost)
            yield from list(between(*arguments))

    monkeypatch.setattr(Crossings, "between", without)
    monkeypatch.setattr(Crossings, "_asked", lambda *_: (finest, None, ROUGH))
    monkeypatch.setattr(crossings, "ASTRAY", 0.0)

    changed = changes(problem, CurveOptions(4.0 * HERTZ, 7.0 * HERTZ))

    assert [each.event for each in changed] == ["branch point"]
    assert asked == 2 * [finest]  # where it is located, and for its error


def until_restart(curve: Iterable[PeriodicResponse]) -> Iterator[PeriodicResponse]:
    """Yield the first piece of a curve; another may come in from beyond the range."""
    return itertools.takewhile(lambda each: each.event != "restart", curve)


def changes(problem: Problem, options: CurveOptions) -> list[PeriodicResponse]:
    """Return where the stability of a curve changes."""
    curve = frequency_response(problem, static_equilibrium(problem), options)
    return [each for each in curve if each.event not in ("", "peak", "fold")]


@pytest.mark.parametrize(
    ("problem", "lowest", "highest", "harmonics", "known"),
    [
        (between_stops(), 1.64, 1.70, 255, 1),
        (between_stops(), 4.0, 7.0, 127, 2),
        pytest.param(
            rig_problem(model="A", friction__law="gkf"),
            134.3,
            135.7,
            255,
            4,
            marks=pytest.mark.long,
        ),
        pytest.param(
            rig_problem(friction__law="gkf"),
            134.5,
            135.5,
            127,
            4,
            marks=pytest.mark.long,
        ),
    ],
    ids=["between stops", "loud between stops", "A", "full"],
)
def test_told_errors_bound_the_true_ones(
    problem: Problem, lowest: float, highest: float, harmonics: int, known: int
) -> None:
    ends = lowest * HERTZ, highest * HERTZ
    fine = CurveOptions(*ends, harmonics=harmonics, samples=16 * (harmonics + 1))

    told, true = changes(problem, CurveOptions(*ends)), changes(problem, fine)

    assert len(told) == known
    for each in told:
        places = [other.frequency for other in true if other.event == each.event]
        aside = min(abs(place - each.frequency) for place in places)
        assert aside <= each.parameter_error < 2e-3 * each.frequency

"""What a curve may cost: counted, and ended."""

import numpy as np
import pytest

from hbm.balance.linearisation import Linearisation
from hbm.continuation.effort import UNIT, Effort
from hbm.continuation.linearised import Linearised
from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from honesty import block
from microslip.studies.gathered import gathered
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium


def test_evaluations_count_by_the_square_of_harmonics_from_31_on() -> None:
    effort = Effort()
    for harmonics in (1, UNIT, 2 * UNIT, 3 * UNIT):
        effort.spend(harmonics)

    assert effort.spent == 1.0 + 1.0 + 4.0 + 9.0


def test_no_evaluation_begins_when_the_effort_is_spent() -> None:
    effort, seen = Effort(2), []

    def system(point: Array) -> tuple[Array, Linearised]:
        seen.append(point)
        return point, Linearisation(lambda: (point, point), np.arange(0), 1)

    counted = effort.counted(system, 1)

    counted(np.zeros(1))
    counted(np.zeros(1))
    with pytest.raises(ContinuationError, match="2 evaluations, is spent: grant more"):
        counted(np.zeros(1))
    assert len(seen) == 2


@pytest.mark.parametrize("granted", [60, 100])
def test_a_curve_keeps_the_points_that_its_effort_allows(granted: int) -> None:
    problem = block()
    rest = static_equilibrium(problem)
    options = CurveOptions(6.0, 20.0, error=1e-2, stability=False, events=False)
    limited = CurveOptions(
        6.0, 20.0, error=1e-2, stability=False, events=False, effort=granted
    )

    whole = list(frequency_response(problem, rest, options))
    kept, ending = gathered(frequency_response(problem, rest, limited))

    assert f"{granted} evaluations, is spent" in ending
    frequencies = [response.frequency for response in whole]
    assert [response.frequency for response in kept] == frequencies[: len(kept)]
    assert granted / 20 < len(kept) < granted


def test_events_are_located_only_where_they_are_wanted() -> None:
    problem = block()
    rest = static_equilibrium(problem)
    wanted = CurveOptions(6.0, 20.0, error=1e-2, stability=False)
    left = CurveOptions(6.0, 20.0, error=1e-2, stability=False, events=False)

    assert "peak" in {each.event for each in frequency_response(problem, rest, wanted)}
    assert {each.event for each in frequency_response(problem, rest, left)} == {""}


def test_harmonics_stay_below_the_most_that_are_allowed() -> None:
    problem = block()
    rest = static_equilibrium(problem)
    few = CurveOptions(6.0, 20.0, error=1e-4, most_harmonics=7, stability=False)

    curve = list(frequency_response(problem, rest, few))

    assert max(each.harmonics for each in curve) == 2 * 7 + 1
    assert max(each.error for each in curve) > 1e-4

"""Steps of a continuation: how long the next one is, and which are refused."""

import math

import pytest

from hbm.continuation.step_control import StepControl


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("factor", [0.5, 1.0, math.sqrt(2.0)])
def test_a_step_is_scaled_so_that_the_extrapolation_misses_by_what_it_may(
    factor: float, order: int
) -> None:
    control = StepControl(initial=0.01, largest=1.0, miss=0.005)
    missed = 0.005 / factor ** (order + 1)

    assert control.after(0.01, missed, order, 2) == pytest.approx(factor * 0.01)


@pytest.mark.parametrize(("missed", "factor"), [(0.0, 2.0), (1e3, 0.3)])
def test_a_step_is_at_most_doubled_and_never_cut_to_less_than_a_third(
    missed: float, factor: float
) -> None:
    control = StepControl(initial=0.01, largest=1.0)

    assert control.after(0.01, missed, 1, 2) == pytest.approx(factor * 0.01)


def test_a_step_shrinks_after_many_iterations_however_well_it_was_predicted() -> None:
    control = StepControl(initial=0.01, largest=1.0, many_iterations=6)

    assert control.after(0.01, 0.0, 1, 6) == pytest.approx(0.02)
    assert control.after(0.01, 0.0, 1, 7) == pytest.approx(0.007)


def test_a_step_stays_between_the_smallest_and_the_largest() -> None:
    control = StepControl(initial=0.01, smallest=0.009, largest=0.011)

    assert control.after(0.01, 0.0, 1, 0) == 0.011
    assert control.after(0.01, 1.0, 1, 20) == 0.009


@pytest.mark.parametrize(
    ("steps", "text"),
    [
        ((0.0, 0.1, 0.2), "steps 0, 0.1, 0.2: give 0 < smallest <= initial <= largest"),
        ((0.1, 0.05, 0.2), "steps 0.1, 0.05, 0.2: give "),
        ((0.01, 0.5, 0.2), "steps 0.01, 0.5, 0.2: give "),
    ],
)
def test_steps_in_a_wrong_order_are_refused(
    steps: tuple[float, float, float], text: str
) -> None:
    smallest, initial, largest = steps
    with pytest.raises(ValueError, match=f"^{text}"):
        StepControl(smallest=smallest, initial=initial, largest=largest)


def test_a_tolerance_that_cannot_be_met_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^tolerance 0: give a positive one$"):
        StepControl(tolerance=0.0)

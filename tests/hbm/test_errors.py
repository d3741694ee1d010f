"""Where a curve cannot go on: the place is named in the units of its parameter."""

import math
import pickle
from collections.abc import Iterator

import pytest

from hbm.errors import PLACE, ContinuationError, hertz, placed


def test_the_place_is_that_of_the_parameter_until_it_has_another_name() -> None:
    error = ContinuationError(f"lost at {PLACE}: try less", 250.0 * math.pi)

    named = error.placed(hertz)

    assert str(error) == "lost at parameter 785.398163: try less"
    assert str(named) == "lost at 125 Hz: try less"
    assert named.parameter == error.parameter


def test_what_passes_a_generator_is_named_on_its_way() -> None:
    def traced() -> Iterator[int]:
        with placed(hertz):
            yield 1
            raise ContinuationError(f"lost at {PLACE}", 2.0 * math.pi)

    with pytest.raises(ContinuationError, match=r"^lost at 1 Hz$"):
        list(traced())


def test_a_text_without_a_place_stays_and_passes_between_processes() -> None:
    error = ContinuationError("the effort is spent: grant more").placed(hertz)

    again = pickle.loads(pickle.dumps(error))

    assert str(again) == str(error) == "the effort is spent: grant more"

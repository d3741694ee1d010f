"""What is said of a search for detached curves."""

import math

from hbm.curves.drive_search import Sought
from microslip.studies.detached import Searched


def sought(hertz: float, share: float, cause: str, *, fold: bool = False) -> Sought:
    return Sought(math.tau * hertz, share, cause, "", fold)


def test_folds_that_were_followed_are_counted_and_those_lost_are_named() -> None:
    steps = (
        sought(10.0, 4.0, ""),
        sought(12.0, 2.5, "too hard"),
        sought(11.0, 4.0, "", fold=True),
        sought(11.0, 0.31, "too soft", fold=True),
    )

    lines = Searched((), steps, 2, interrupted=True).lines()

    assert lines == [
        "detached curves sought at 2 of 15 frequencies, 10.000 to 12.000 Hz, by 0.05 "
        "to 4 times the drive",
        "and from 1 of 2 folds, followed to 4 and 0.05 times the drive or until they "
        "come back",
        "at 12.000 Hz only up to 2.5 times the drive: too hard",
        "the fold at 11.000 Hz only to 0.31 times the drive: too soft",
        "no detached curve was found",
    ]


def test_what_a_drive_is_needed_for_that_begins_contact_is_told() -> None:
    steps = (sought(10.0, 40.0, ""), sought(12.0, 4.0, ""))

    lines = Searched((), steps, 0, interrupted=False).lines()

    assert lines[0] == (
        "detached curves sought at 2 of 15 frequencies, 10.000 to 12.000 Hz, by 0.05 "
        "to 4 times the drive, and to 40 times where it is linear up to there"
    )


def test_without_folds_nothing_is_said_of_them() -> None:
    lines = Searched((), (sought(10.0, 4.0, ""),), 0, interrupted=False).lines()

    assert not any("fold" in line for line in lines)

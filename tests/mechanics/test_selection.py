"""Degrees of freedom by name, node, pattern and set."""

import re

import pytest

from microslip_mechanics.structures.selection import selected

NAMES = ("root.x", "root.y", "12.x", "12.z", "13.z", "tip.x", "tip.ry")


@pytest.mark.parametrize(
    ("patterns", "places"),
    [
        (["tip.x"], [5]),
        (["tip"], [5, 6]),
        (["tip.*", "12.x"], [2, 5, 6]),
        (["1?.z", "12"], [2, 3, 4]),
        (["*.z"], [3, 4]),
        (["shroud"], [0, 1, 4]),
        (["shroud", "root.x"], [0, 1, 4]),
        ([], []),
    ],
)
def test_patterns_and_sets_choose(patterns: list[str], places: list[int]) -> None:
    found = selected(NAMES, patterns, {"shroud": ("13.z", "root")})

    assert found.tolist() == places


@pytest.mark.parametrize(
    ("pattern", "message"),
    [
        (
            "tip.y",
            "no degree of freedom is called 'tip.y': did you mean tip.ry?",
        ),
        ("tap", "no degree of freedom is called 'tap': did you mean tip?"),
        ("?", "no degree of freedom is called '?': the first name is root.x"),
        ("lost", "no degree of freedom is called 'nowhere.x': the first name is"),
    ],
)
def test_a_pattern_that_matches_nothing_is_refused(pattern: str, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        selected(NAMES, [pattern], {"lost": ("tip", "nowhere.x")})

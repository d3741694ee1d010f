"""Checks of numbers that a user gives."""

from __future__ import annotations

import math


def check_positive(name: str, value: float) -> None:
    """Refuse a number that is not positive, or not finite.

    Raises
    ------
    ValueError
        With its name and value.
    """
    if not 0.0 < value < math.inf:
        raise ValueError(f"{name} {value:g}: give a positive number")


def check_harmonics(harmonics: int | None) -> None:
    """Refuse a fixed number of harmonics below one; None leaves it open.

    Raises
    ------
    ValueError
        With the number.
    """
    if harmonics is not None and harmonics < 1:
        raise ValueError(
            f"harmonics {harmonics}: give at least 1, or None for as many as the error "
            "asks for"
        )

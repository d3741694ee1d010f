"""Errors at the border: of what a user has given, and those that end a command."""

from __future__ import annotations

from microslip_mechanics.errors import MicroslipError

EXPECTED = (MicroslipError, ValueError, ArithmeticError, RuntimeWarning, MemoryError)
"""what ends a command in one line; anything else is a defect"""


class GivenError(MicroslipError):
    """A scene, an argument or a file that cannot be used: which, and what to do."""


def one_line(error: BaseException) -> str:
    """Return an error's text in one line; its kind, if it has none."""
    return " ".join(str(error).split()) or type(error).__name__

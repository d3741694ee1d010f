"""What is raised where a curve cannot go on."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator

from microslip_mechanics.errors import MicroslipError

PLACE = "{place}"
"""stands for the place in the text of an error"""
REMEDY = (
    "another tolerance, more harmonics, more samples or, where friction has one, a "
    "larger threshold velocity may help"
)


class ContinuationError(MicroslipError):
    """The curve cannot go on; the text says where, why and what to try."""

    def __init__(self, text: str, parameter: float | None = None) -> None:
        """Name the ``parameter`` where ``text`` has :data:`PLACE`."""
        named = "" if parameter is None else f"parameter {parameter:.9g}"
        super().__init__(text.replace(PLACE, named))
        self._text, self.parameter = text, parameter

    def with_remedy(self, remedy: str) -> ContinuationError:
        """Return the error with another thing to try."""
        return type(self)(f"{self._text}; {remedy}", self.parameter)

    def placed(self, name: Callable[[float], str]) -> ContinuationError:
        """Return the error with the place named by a function of the parameter."""
        if self.parameter is None:
            return self
        text = self._text.replace(PLACE, name(self.parameter))
        return type(self)(text, self.parameter)


class UnboundedError(ContinuationError):
    """The curve goes on for ever: no restart would lead past that."""


class ReturnedError(ContinuationError):
    """The curve is where it has been: it is no corner, and goes round for ever."""


class RetracedError(ReturnedError):
    """It goes back on itself, from the parameter that is told."""


@contextlib.contextmanager
def placed(name: Callable[[float], str]) -> Iterator[None]:
    """Name the places of errors by a function of the parameter."""
    try:
        yield
    except ContinuationError as error:
        raise error.placed(name) from None


def hertz(frequency: float) -> str:
    """Return the name of a place on a curve along frequency [rad/s]."""
    return f"{frequency / math.tau:.9g} Hz"


def drives(share: float) -> str:
    """Return the name of a place on a curve along the drive, over the wanted one."""
    return f"{share:.3g} times the drive"

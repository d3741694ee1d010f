"""Quantities: fields with a unit and a range, read from numbers and from texts."""

from __future__ import annotations

import math
import numbers
import re
from dataclasses import MISSING, dataclass, field, fields, replace
from typing import Any

UNITS = {
    "m": {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6},
    "kg": {"kg": 1.0, "g": 1e-3},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6},
    "Hz": {"Hz": 1.0, "kHz": 1e3},
    "N": {"N": 1.0, "mN": 1e-3, "kN": 1e3},
    "N/m": {"N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3, "MN/m": 1e6, "kN/mm": 1e6},
    "Pa": {"Pa": 1.0, "MPa": 1e6, "GPa": 1e9},
    "kg/m^3": {"kg/m^3": 1.0, "g/cm^3": 1e3},
    "kg m^2": {"kg m^2": 1.0, "kg mm^2": 1e-6, "g mm^2": 1e-9},
    "rad": {"rad": 1.0, "deg": math.pi / 180.0},
    "m/s": {"m/s": 1.0, "mm/s": 1e-3},
    "m/s^2": {"m/s^2": 1.0, "mm/s^2": 1e-3},
    "1/s": {"1/s": 1.0},
    "rad/s": {"rad/s": 1.0, "Hz": 2.0 * math.pi, "rpm": math.pi / 30.0},
    "N s/m": {"N s/m": 1.0},
    "N s^2/m^2": {"N s^2/m^2": 1.0},
    "N/m^3": {"N/m^3": 1.0, "N/mm^3": 1e9},
    "N/m^p": {"N/m^p": 1.0},
    "N s/m^(q+1)": {"N s/m^(q+1)": 1.0},
    "": {"": 1.0},
}
"""for each SI unit, the units that may be written and their size in it"""
NUMBER = re.compile(r"[-+]?(\d[\d_]*\.?\d*|\.\d+)(e[-+]?\d+)?(?![\d.,])", re.I)
"""at the beginning of a text, before a unit"""

LARGEST = 1e50
"""of any number, and of the inverse of any other than zero: squares and products of a
few are numbers still"""


@dataclass(frozen=True, slots=True)
class Quantity:
    """What a number may be."""

    unit: str
    """SI unit, a key of UNITS"""
    lowest: float
    highest: float
    positive: bool
    """whether the lower bound itself is excluded"""

    def read(self, value: object) -> float:
        """Return the value in SI units; raise ValueError with cause and remedy."""
        number = self._number(value)
        if abs(number) > LARGEST:
            raise ValueError(
                f"is out of range: give at most {LARGEST:g} in size, or what is "
                "reckoned with it overflows"
            )
        if 0.0 < abs(number) < 1.0 / LARGEST:
            zero = "" if self.positive else "0 or "
            raise ValueError(
                f"is out of range: give {zero}at least {1.0 / LARGEST:g} in size, or "
                "what is reckoned with it vanishes"
            )
        inside = self.lowest <= number <= self.highest
        if not inside or (self.positive and number == self.lowest):
            raise ValueError(f"is out of range: {self._range()}")
        return number

    def of_power(self, power: object) -> Quantity:
        """Return the same with the units of a force over a displacement's power."""
        linear = self.unit == "N/m^p" and power == 1.0
        return replace(self, unit="N/m") if linear else self

    def _number(self, value: object) -> float:
        if isinstance(value, bool) or not isinstance(value, (numbers.Real, str)):
            raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
                f"is not a number: give one{self._unit_hint()}"
            )
        if isinstance(value, str):
            return self._with_unit(value)
        try:
            number = float(value)
        except OverflowError:
            raise ValueError(f"is out of range: {self._range()}") from None
        if not math.isfinite(number):
            raise ValueError("is not finite: give a finite number")
        return number

    def _with_unit(self, text: str) -> float:
        stripped = text.strip().replace("\u03bc", "µ")  # the Greek letter for the sign
        found = NUMBER.match(stripped)
        first = found[0] if found else stripped.partition(" ")[0]
        try:
            number = float(first)
        except ValueError:
            raise ValueError(f"is not a number: give one{self._unit_hint()}") from None
        unit = stripped[len(first) :].strip()
        if unit not in UNITS[self.unit]:
            raise ValueError(f"has the wrong unit: give a number{self._unit_hint()}")
        if not math.isfinite(number):
            raise ValueError("is not finite: give a finite number")
        return number * UNITS[self.unit][unit]

    def _unit_hint(self) -> str:
        known = [f'"{unit}"' for unit in UNITS[self.unit] if unit.isascii() and unit]
        if not known:
            return ", without a unit"
        return f" in {self.unit}, or a text with one of the units {', '.join(known)}"

    def _range(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        if self.positive and math.isinf(self.highest):
            return f"it must be above {self.lowest:g}{unit}"
        if math.isinf(self.highest):
            return f"it must be at least {self.lowest:g}{unit}"
        edge = (
            f"above {self.lowest:g}" if self.positive else f"at least {self.lowest:g}"
        )
        return f"it must be {edge} and at most {self.highest:g}{unit}"


def apart(low: float, high: float) -> tuple[str, str]:
    """Return two numbers as texts, with as many digits as tell them apart."""
    digits = 6
    while digits < 17 and low != high and f"{low:.{digits}g}" == f"{high:.{digits}g}":
        digits += 1
    return f"{low:.{digits}g}", f"{high:.{digits}g}"


def quantity(
    unit: str = "",
    *,
    lowest: float = -math.inf,
    highest: float = math.inf,
    positive: bool = False,
    optional: bool = False,
    default: object = MISSING,
    told: tuple[str, str] | None = None,
) -> Any:  # noqa: ANN401  (a dataclass field, like dataclasses.field)
    """Declare a number with its SI unit and its range.

    ``positive`` sets the lower bound to zero and excludes the bound itself;
    ``optional`` makes None of a number that is left out, ``default`` another value.
    ``told`` is what the documentation says of a range that its dataclass checks, empty
    if there is none, and of a number that is left out.
    """
    low = max(lowest, 0.0) if positive else lowest
    metadata = {"quantity": Quantity(unit, low, highest, positive), "told": told}
    if optional:
        default = None
    return field(default=default, metadata=metadata)


def check_quantities(made: Any, name: str) -> None:  # noqa: ANN401  (a dataclass)
    """Check the numbers of a dataclass that was made in Python.

    Raises
    ------
    ValueError
        With ``name``, the field, its value and what it may be.
    """
    for each in fields(made):
        kind, value = each.metadata.get("quantity"), getattr(made, each.name)
        if kind is None or value is each.default or isinstance(each.default, bool):
            continue
        if isinstance(value, bool):
            raise ValueError(  # noqa: TRY004  (as below)
                f"{name}: {each.name} = {value}: give a number"
            )
        if isinstance(value, str):
            raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
                f"{name}: {each.name} = {value!r} is a text: give a number in SI units"
            )
        if not isinstance(value, numbers.Real):
            raise ValueError(  # noqa: TRY004  (as above)
                f"{name}: {each.name} = {value}: is not a number: give one in SI units"
            )
        try:
            number = kind.read(value)
        except ValueError as error:
            raise ValueError(f"{name}: {each.name} = {value}: {error}") from None
        if each.type == "int" and number % 1.0:
            raise ValueError(
                f"{name}: {each.name} = {value}: is not a whole number: give one"
            )

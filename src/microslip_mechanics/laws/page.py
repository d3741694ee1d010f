"""The page of the documentation on laws, made from the catalogue."""

from __future__ import annotations

import dataclasses
import inspect
from typing import Any

from microslip_mechanics.laws.catalogue import LAWS
from microslip_mechanics.laws.parameters import HEAD as PARAMETERS
from microslip_mechanics.laws.parameters import left_out, values

HEAD = """\
# Laws of elements

An element of a scene (`law = "jenkins"`) or of Python (`microslip.Jenkins`) obeys one
of these laws. Symbols: w is the displacement of the element's first end relative to its
second, w_n that along a contact's normal (positive in penetration), w_t that along its
tangents, ẇ and v their rates. Directions are given as `between`, or as `normal`,
`tangents` and `rotations`; each is a pair of ends, and the ground is written as
`"ground"`; friction under a constant `load` has no `normal`. A stiffness in N/m^p
whose power p is 1 may be written as `"5 kN/m"` too.

`python -m microslip_mechanics.laws.page > docs/laws.md` writes this page.
"""


def laws_page() -> str:
    """Return the page as Markdown."""
    return "\n".join([HEAD, *(_law(name, law) for name, law in LAWS.items())])


def _law(name: str, law: type[Any]) -> str:
    """Return the section of one law."""
    text = inspect.cleandoc(str(law.__doc__)).partition(PARAMETERS)[0]
    equation, _, more = text.partition("\n")
    lines = [f"## `{name}`", "", f"Python: `microslip.{law.__name__}`", "", equation]
    if more.strip():
        lines += ["", more.strip()]
    takes = object.__new__(law).takes  # of the numbers that may be left out
    lines += ["", f"Directions: {', '.join(f'`{key}`' for key in takes)}."]
    lines += ["", "| key | unit | value | if left out |", "|---|---|---|---|"]
    lines += [_row(field) for field in dataclasses.fields(law)]
    return "\n".join([*lines, ""])


def _row(field: dataclasses.Field[Any]) -> str:
    """Return the line of one number."""
    unit = field.metadata["quantity"].unit
    return f"| `{field.name}` | {unit} | {values(field)} | {left_out(field)} |"


if __name__ == "__main__":
    import sys

    sys.stdout.write(laws_page())

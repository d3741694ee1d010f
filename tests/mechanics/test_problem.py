"""Problem: everything speaks of the same degrees of freedom."""

import re
from typing import Any

import numpy as np
import pytest

from contact_tables import contact_points
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structures.structure import Structure

DOFS = 4


def problem(**parts: Any) -> Problem:
    identity = np.eye(DOFS)
    sound: dict[str, Any] = {
        "structure": Structure(identity, identity, identity, tuple("abcd")),
        "interface": interface(DOFS),
        "preload": np.ones(DOFS),
        "drive": np.ones(DOFS),
        "probes": Probes(("tip",), np.ones((1, DOFS))),
    }
    return Problem(**(sound | parts))


def interface(dofs: int) -> Interface:
    return Interface(contact_points(), np.eye(3, dofs), ("point",))


def test_parts_that_fit_make_a_problem() -> None:
    whole = problem()

    assert whole.interface.displacement.shape == (3, whole.structure.dofs)


def test_a_problem_equals_itself_and_is_a_key() -> None:
    one, other = problem(), problem()

    assert one == one
    assert one != other
    assert {one: "curve"}[one] == "curve"


@pytest.mark.parametrize(
    ("told", "entry", "parts"),
    [
        ("preload has shape (5,)", "number", {"preload": np.ones(5)}),
        ("drive has shape (4, 1)", "number", {"drive": np.ones((DOFS, 1))}),
        (
            "interface.displacement has shape (3, 5)",
            "column",
            {"interface": interface(5)},
        ),
        (
            "probes.rows has shape (1, 5)",
            "column",
            {"probes": Probes(("tip",), np.ones((1, 5)))},
        ),
    ],
)
def test_part_of_another_size_is_refused(
    told: str, entry: str, parts: dict[str, Any]
) -> None:
    message = (
        f"{told}, but the structure has 4 degrees of freedom: give a {entry} for each"
    )

    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        problem(**parts)


@pytest.mark.parametrize("name", ["preload", "drive"])
@pytest.mark.parametrize("value", [np.nan, -np.inf])
def test_load_with_a_value_that_is_not_finite_is_refused(
    name: str, value: float
) -> None:
    load = np.ones(DOFS)
    load[2] = value

    message = f"{name} holds a value that is not finite: give finite forces"
    with pytest.raises(ValueError, match=f"^{message}$"):
        problem(**{name: load})


def test_probes_without_a_row_each_are_refused() -> None:
    with pytest.raises(ValueError, match=r"shape \(1, 4\), but there are 2 names"):
        Probes(("tip", "root"), np.ones((1, DOFS)))

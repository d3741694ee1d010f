"""Masked values of numpy: they hold no numbers."""

from typing import Any

import numpy as np
import pytest

import microslip

CHAIN: dict[str, Any] = {"mass": [1.0, 1.0], "stiffness": [[2.0, -1.0], [-1.0, 1.0]]}
HALF = np.ma.array([0.5, 0.5], mask=[False, True])
NAMES = (
    "mass",
    "stiffness",
    "damping_ratio",
    "loss_factor",
    "rayleigh_damping",
    "damping",
)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("value", [np.ma.masked, HALF], ids=["all", "half"])
def test_masked_entries_of_a_system_are_refused(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match=rf"^{name} .*give ") as caught:
        microslip.system(**CHAIN | {name: value})

    assert len(str(caught.value).splitlines()) == 1


def test_entries_that_are_not_masked_are_taken() -> None:
    whole = np.ma.array([0.01, 0.02], mask=[False, False])

    assert microslip.system(**CHAIN, damping_ratio=whole).structure.dofs == 2


def test_masked_arguments_of_curves_and_sweeps_are_refused() -> None:
    duffing = microslip.scene("duffing")

    with pytest.raises(
        microslip.MicroslipError, match=r"^microslip\.curve: lowest is masked: give"
    ):
        microslip.curve(duffing, np.ma.masked, 5.0)  # type: ignore[arg-type]
    with pytest.raises(
        microslip.MicroslipError, match=r"^microslip\.sweep: time_step is masked: give"
    ):
        microslip.sweep(duffing, 4.0, 5.0, duration=0.1, time_step=np.ma.masked)  # type: ignore[arg-type]

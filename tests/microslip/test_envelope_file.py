"""Envelopes whose first cycle is longer than a block of the march."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest

from microslip.files.result_file import load
from microslip_mechanics.results.envelope import Envelope

Run: TypeAlias = Callable[..., tuple[int, str, str]]
SLOW = ("sweep.end=2 s", "sweep.duration=2 s", "sweep.lowest=1", "sweep.highest=2")


@pytest.mark.usefixtures("no_picture")
@pytest.mark.parametrize("scene", ["jenkins", "gap"])
def test_cycles_that_take_several_blocks_have_an_envelope(
    scene: str, run: Run, tmp_path: Path
) -> None:
    words = [word for each in SLOW for word in ("--set", each)]

    status, output, error = run("sweep", scene, *words, "--envelope", "-o", "slow")

    assert (status, error) == (0, "")
    # (2 - 1) / ln 2 x 2 turns of an exponential sweep
    assert "3 cycles in slow.nc" in output
    envelope = load(tmp_path / "slow.nc").result
    assert isinstance(envelope, Envelope)
    assert envelope.iterations > 0
    assert envelope.work_difference.size == (3 if scene == "gap" else 0)

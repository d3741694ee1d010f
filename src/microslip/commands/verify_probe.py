"""The probe whose amplitude the tables of microslip verify show."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from microslip_mechanics.arrays import Array


def moving(amplitudes: Sequence[Array]) -> tuple[int, float]:
    """Return a probe that moves, and the largest of its amplitudes [m]."""
    import numpy as np

    from microslip_mechanics.results.moving_probe import moving_probe

    if not amplitudes:
        return 0, 0.0
    sizes = np.array(amplitudes)
    probe = moving_probe(sizes)
    return probe, float(sizes[:, probe].max())

"""Whether the energy balance of a march closes: a check, not a measure (theory, §7)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.time_history import TimeHistory


def closes(history: TimeHistory, tolerance: float) -> bool:
    """Return whether the closing error stays below a share of the energy put in.

    A march that is wrong may still close, one that does not close is wrong.
    """
    put_in = np.abs(history.of("input")).max() + abs(history.stored_at_start)
    return bool(np.abs(history.closing_error).max() <= tolerance * put_in)

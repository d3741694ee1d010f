"""Whether the energy balance of a march closes: a check, not a measure (§7.1)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory

OPEN = "the energy balance does not close, so the march is wrong"
"""of a march that :func:`closes` denies"""
CLOSES = 1e-2
"""closing error from which on no march is believed"""
MATTERS = 1e-3
"""share of the input from which on friction is what the error is compared with"""


def closes(result: TimeHistory | Envelope) -> bool:
    """Return whether the closing error stays below a share of the energies.

    They are what friction takes out, where that is a thousandth of the input or more,
    and the input else. A march that is wrong may still close; one that does not close
    is wrong.
    """
    put_in = np.abs(result.of("input")).max() + abs(result.stored_at_start)
    rubbed = np.abs(result.of("friction")).max()
    size = rubbed if rubbed > MATTERS * put_in else put_in
    return bool(np.abs(result.closing_error).max() <= CLOSES * size)

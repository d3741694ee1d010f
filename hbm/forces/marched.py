"""Which friction is marched to its steady loop (theory §6.5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import PUSHED, ContactPoints


def marched(points: ContactPoints) -> NDArray[np.bool_]:
    """Return which points have friction that is marched, shape (points,)."""
    which: NDArray[np.bool_] = remembers(points) | (points.friction == PUSHED)
    return which

"""Where nothing bounds a response: resonance without enough damping (theory §6.2)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from hbm.continuation.correction import Correction
from hbm.errors import PLACE, UnboundedError
from microslip_mechanics.arrays import Array

LARGEST = 1e8
"""of a motion, over that where a curve is lowest: a damping ratio of 1e-8 is none"""


def bounded(
    corrections: Iterable[Correction], rank: int, size: Callable[[Array], float]
) -> Iterator[Correction]:
    """Yield corrections along frequency while what they say is bounded.

    Parameters
    ----------
    corrections
        Of ``rank`` coordinates, such as relative motions, which grow without bounds
        also where contacts cease to stick.
    size
        Point ↦ that of the structure's vibration.

    Raises
    ------
    UnboundedError
        If the amplitude grows without end.
    """
    least, lowest = math.inf, 0.0
    for each in corrections:
        moved = float(np.linalg.norm(each.point[rank:-1]))
        if 0.0 < moved < least:
            least, lowest = moved, size(each.point)
        if moved > LARGEST * least and size(each.point) > LARGEST * lowest:
            raise UnboundedError(
                f"the response is not bounded at {PLACE}: its amplitude grows without "
                "end, as neither the structure's damping nor its contacts take in what "
                "the drive does; give the structure some damping",
                float(each.point[-1]),
            )
        yield each

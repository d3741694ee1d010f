"""Where nothing bounds a response: resonance without enough damping (theory §6.2)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from hbm.continuation.correction import Correction
from hbm.errors import PLACE, UnboundedError

LARGEST = 1e8
"""of a vibration, over the smallest on its curve: a damping ratio of 1e-8 is none"""


def bounded(corrections: Iterable[Correction], rank: int) -> Iterator[Correction]:
    """Yield corrections along frequency while what they say is bounded.

    ``rank`` is the number of coordinates.

    Raises
    ------
    UnboundedError
        If the amplitude grows without end.
    """
    least = math.inf
    for each in corrections:
        size = float(np.linalg.norm(each.point[rank:-1]))
        least = min(least, size or math.inf)
        if size > LARGEST * least:
            raise UnboundedError(
                f"the response is not bounded at {PLACE}: its amplitude grows without "
                "end, as neither the structure's damping nor its contacts take in what "
                "the drive does; give the structure some damping",
                float(each.point[-1]),
            )
        yield each

"""Responses gathered until their source ends, stops or is interrupted."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from hbm.errors import ContinuationError
from microslip.interruption import unmasked
from microslip_mechanics.results.response import PeriodicResponse


def gathered(
    responses: Iterable[PeriodicResponse],
) -> tuple[list[PeriodicResponse], str]:
    """Return the responses until their source ends, stops or is interrupted, and why.

    Those that a later one replaces are left out, and none of the rest replaces any.

    Raises
    ------
    ContinuationError, KeyboardInterrupt
        If there is no response yet.
    """
    found: list[PeriodicResponse] = []
    try:
        with unmasked():
            for response in responses:  # what is there must be kept
                if response.replaces:
                    del found[len(found) - response.replaces :]
                    response = replace(response, replaces=0)
                found.append(response)
    except (ContinuationError, KeyboardInterrupt) as cause:
        if not found:
            raise
        return found, str(cause) or "interrupted"
    return found, "complete"

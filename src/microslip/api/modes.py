"""Nonlinear modes in plain Python."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from microslip.api.arguments import check_apart, check_single, checked, named, read
from microslip.errors import GivenError
from microslip.scenes.experiments import HERTZ
from microslip.scenes.quantity import quantity
from microslip_mechanics.quantity import apart

if TYPE_CHECKING:
    from microslip.studies.modes import FollowedMode
    from microslip_mechanics.problem import Problem

NAME = "microslip.modes"


@dataclass(frozen=True, slots=True)
class Asked:
    """What :func:`modes` is asked for."""

    lowest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    highest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    smallest: float = quantity("m", positive=True)
    largest: float = quantity("m", positive=True)
    tolerance: float = quantity(default=1e-2, lowest=1e-6, highest=0.5)
    harmonics: int | None = quantity(lowest=1, highest=127, optional=True)


def modes(
    problem: Problem,
    lowest: float | str,
    highest: float | str,
    *,
    smallest: float | str = 1e-5,
    largest: float | str = 1e-2,
    tolerance: float | None = None,
    harmonics: int | None = None,
) -> tuple[FollowedMode, ...]:
    """Return the modes of free decaying motion, natural frequency against amplitude.

    Parameters
    ----------
    problem
        From :func:`microslip.system` or :func:`microslip.scene`.
    lowest, highest
        Between which natural frequencies of small motions lie [Hz].
    smallest, largest
        Amplitudes between which each mode is followed [m]: of the linear mode's
        largest probe; as the shape changes, that of a point becomes another one.
    tolerance
        Relative error of the damping ratio at each point, of the frequency a hundredth
        of it, from which harmonics follow; 0.01 if it is left out.
    harmonics
        Fixed number instead.

    Returns
    -------
    tuple
        For each mode, the lowest first, ``points`` with ``amplitude`` [m],
        ``frequency`` [rad/s] and ``damping`` (ratio), their relative errors
        ``frequency_error`` and ``damping_error``, and an ``ending``. From the point
        ``coarser`` on, unless it is None, they have fewer harmonics than the tolerance
        asks for: with those the mode did not go on. ``damping`` is what a cycle
        dissipates: an amplitude on which the frequency depends falls faster or more
        slowly in a free decay (``microslip decay`` tells both). Where ``apart``, the
        first point's motion is not that of the linear mode: begin with a smaller one.

    Raises
    ------
    MicroslipError
        If an argument is of no use, or if there is no mode in the range.
    """
    from hbm.modes.mode_options import ModeOptions
    from microslip.studies.modes import followed

    check_single(NAME, tolerance, harmonics)
    asked: Asked = read(
        NAME,
        Asked,
        lowest=lowest,
        highest=highest,
        smallest=smallest,
        largest=largest,
        tolerance=tolerance,
        harmonics=harmonics,
    )
    check_apart(NAME, asked.lowest, asked.highest)
    if not asked.smallest < asked.largest:
        low, high = apart(asked.smallest, asked.largest)
        raise GivenError(
            f"{NAME}: smallest = {low} m, largest = {high} m: give the smaller one "
            "first"
        )
    given = checked(NAME, problem)
    turn = sorted((math.tau * asked.lowest, math.tau * asked.highest))
    options = ModeOptions(
        asked.smallest,
        asked.largest,
        error=asked.tolerance,
        harmonics=asked.harmonics,
    )
    with named(NAME):
        return tuple(followed(given, (turn[0], turn[1]), options))

"""Rows of motions whose extremes are known."""

import numpy as np

from microslip_mechanics.arrays import Array


def swings(step: float, end: float = 40.0) -> tuple[Array, Array, Array]:
    """Return rows of two motions: amplitude 1 about 0, and 2 about 1."""
    time = np.arange(0.013, end, step)
    other = time + 0.3
    moved = np.stack([np.sin(time), 1.0 + 2.0 * np.cos(other)], axis=1)
    moving = np.stack([np.cos(time), -2.0 * np.sin(other)], axis=1)
    return time, moved, moving


def bounces(step: float) -> tuple[Array, Array, Array]:
    """Return rows of a motion that flies with speed 1 between soft and hard stops."""
    fine = np.arange(0.0, 40.0, 1e-4)
    place, speed, path, rate = 0.0, 1.0, [], []
    for _ in fine:
        path.append(place)
        rate.append(speed)
        beyond = place - np.clip(place, -0.5, 0.5)
        speed -= 1e-4 * (2500.0 if beyond > 0.0 else 1e4) * beyond
        place += 1e-4 * speed
    rows = slice(3, None, round(step / 1e-4))
    return fine[rows], np.array(path)[rows, None], np.array(rate)[rows, None]

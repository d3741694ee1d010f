"""An oscillator against a one-sided spring: free, and driven past a gap."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.linalg
from scipy.optimize import fsolve

import microslip
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import modes_in_range, nonlinear_mode
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from references.curves import curve, first, oscillator
from references.finding import Finding

STOP = 3.0
"""stiffness of the one-sided spring over that of the oscillator"""
GAP, DAMPING, DRIVE = 1.0, 0.1, 0.3
FREE = "Shaw, Holmes (1983), J. Sound Vib. 90, 129-155: two half periods"
DRIVEN = "Natsiavas (1989), J. Sound Vib. 134, 315-331: matched linear pieces"


def findings() -> Iterator[Finding]:
    """Yield what is known of it."""
    yield _free()
    yield from _driven()


def _free() -> Finding:
    """Return the natural frequency of a spring that is stiffer on one side."""
    problem = oscillator(microslip.UnilateralSpring(stiffness=STOP, gap=0.0))
    rest = static_equilibrium(problem)
    linear = modes_in_range(problem, rest, 0.1, 10.0)[0]
    options = ModeOptions(0.5, 1.0, harmonics=63)
    mode = list(nonlinear_mode(problem, rest, linear, options))[-1]
    stiff = math.sqrt(1.0 + STOP)
    known = 2.0 * stiff / (1.0 + stiff)
    system, quantity = "bilinear oscillator", "natural frequency [rad/s]"
    return Finding(system, quantity, FREE, known, mode.frequency, 1e-9)


def _driven() -> Iterator[Finding]:
    """Yield amplitude and multipliers of motions that touch the stop once a period."""
    law = microslip.UnilateralSpring(stiffness=STOP, gap=GAP)
    problem = oscillator(law, damping=DAMPING, drive=DRIVE)
    points = curve(problem, 0.8, 1.6, 63, 2048)
    touching = [each for each in points if first(each) > 1.2 * GAP]
    for response in (touching[0], max(touching, key=first)):
        pieces = Pieces.near(response)
        name = f"at {response.frequency:.4f} rad/s"
        system = "stop behind a gap"
        quantity = f"amplitude {name} [m]"
        yield Finding(system, quantity, DRIVEN, pieces.first, first(response), 2e-6)
        found = float(np.abs(response.multipliers).max())
        known = pieces.multiplier
        quantity = f"largest multiplier {name}"
        yield Finding(system, quantity, DRIVEN, known, found, 1e-6)


@dataclass(frozen=True, slots=True)
class Pieces:
    """A periodic motion of two linear pieces, exact but for rounding."""

    frequency: float
    touched: float
    """time at which the stop is met [s]"""
    speed: float
    """there [m/s]"""
    left: float
    """time at which it is left [s]"""

    @classmethod
    def near(cls, response: PeriodicResponse) -> Pieces:
        """Return the motion near that of a response."""
        frequency = response.frequency
        phase = np.linspace(0.0, 4.0 * math.pi, 8001)
        place, speed = (part[:, 0] for part in response.at(phase))
        inside = place > GAP
        enters = int(np.flatnonzero(~inside[:-1] & inside[1:])[0])
        leaves = enters + 1 + int(np.argmin(inside[enters + 1 :]))
        guess = [phase[enters] / frequency, speed[enters], phase[leaves] / frequency]

        def misses(unknown: Array) -> list[float]:
            touched, velocity, left = unknown
            out = _flow(1.0 + STOP, frequency, left - touched) @ _state(
                frequency, touched, velocity
            )
            period = 2.0 * math.pi / frequency
            back = _flow(1.0, frequency, touched + period - left) @ out
            return [out[0] - GAP, back[0] - GAP, back[1] - velocity]

        found = fsolve(misses, guess, xtol=1e-12)
        return cls(frequency, *map(float, found))

    @property
    def first(self) -> float:
        """Amplitude of the first harmonic [m], by Gauss' rule on each piece."""
        period = 2.0 * math.pi / self.frequency
        nodes, weights = np.polynomial.legendre.leggauss(40)
        state = _state(self.frequency, self.touched, self.speed)
        total, time = 0.0j, self.touched
        for stiffness, until in ((1.0 + STOP, self.left), (1.0, self.touched + period)):
            span = until - time
            for node, weight in zip((nodes + 1.0) / 2.0, weights / 2.0, strict=True):
                at = _flow(stiffness, self.frequency, node * span) @ state
                wave = np.exp(-1j * self.frequency * (time + node * span))
                total += weight * span * at[0] * wave
            state = _flow(stiffness, self.frequency, span) @ state
            time = until
        return abs(total) * 2.0 / period

    @property
    def multiplier(self) -> float:
        """Largest magnitude of the multipliers: the force has no jumps."""
        inside = self.left - self.touched
        outside = 2.0 * math.pi / self.frequency - inside
        free = _flow(1.0, self.frequency, outside)[:2, :2]
        once = free @ _flow(1.0 + STOP, self.frequency, inside)[:2, :2]
        return float(np.abs(np.linalg.eigvals(once)).max())


def _state(frequency: float, time: float, speed: float) -> Array:
    """Return place, velocity, the stop's pull, and the drive's phase at a touch."""
    turn = frequency * time
    return np.array([GAP, speed, 1.0, math.cos(turn), math.sin(turn)])


def _flow(stiffness: float, frequency: float, duration: float) -> Array:
    """Return the map of such a state over a duration, shape (5, 5)."""
    rate = np.zeros((5, 5))
    rate[0, 1] = 1.0
    rate[1] = [-stiffness, -DAMPING, (stiffness - 1.0) * GAP, 0.0, DRIVE]
    rate[3, 4], rate[4, 3] = -frequency, frequency
    made: Array = scipy.linalg.expm(rate * duration)
    return made

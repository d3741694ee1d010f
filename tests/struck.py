"""The exact motion of a mass that strikes a stop, which is linear piece by piece."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import simpson
from scipy.linalg import expm
from scipy.optimize import root

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.record.start import Start

MASS, STIFFNESS, GAP, DRIVE = 1.0, 1e3, 5e-4, 0.05
DAMPING = 2.0 * 0.03 * np.sqrt(MASS * STIFFNESS)
"""of the scene "gap", but for the drive, in SI units"""


@dataclass(frozen=True)
class Struck:
    """Motions that touch a stop once a period; exact but for rounding."""

    stop: float
    """its stiffness [N/m]"""
    drive: float = DRIVE

    def carried(self, omega: float, time: float, *, touching: bool) -> Array:
        """Return what carries x, v, cos ωt, sin ωt and 1 on over a time, (5, 5)."""
        held = self.stop if touching else 0.0
        rates = np.zeros((5, 5))
        rates[0, 1] = 1.0
        rates[1] = [-(STIFFNESS + held), -DAMPING, 0.0, self.drive, held * GAP]
        rates[1] /= MASS
        rates[2, 3], rates[3, 2] = -omega, omega
        return np.asarray(expm(rates * time))

    def period(self, omega: float, touching: float) -> tuple[Array, Array]:
        """Return the maps of the time that it touches and of the rest of a period."""
        rest = 2.0 * np.pi / omega - touching
        return (
            self.carried(omega, touching, touching=True),
            self.carried(omega, rest, touching=False),
        )

    def missed(self, unknown: Array, phase: float) -> Array:
        """Return what a motion that touches first at a phase of the drive misses.

        ``unknown`` is ω, the time of touch over a period, and the speed over ω GAP.
        """
        omega, share, speed = unknown
        size = GAP * omega
        begin = np.array([GAP, speed * size, np.cos(phase), np.sin(phase), 1.0])
        on, off = self.period(omega, share * 2.0 * np.pi / omega)
        left = on @ begin
        again = off @ left
        return np.array(
            [left[0] / GAP - 1.0, again[0] / GAP - 1.0, again[1] / size - speed]
        )

    def multiplier(self, omega: float, touching: float) -> float:
        """Return the largest Floquet multiplier's modulus: forces are continuous."""
        on, off = self.period(omega, touching)
        values = np.linalg.eigvals(off[:2, :2] @ on[:2, :2])
        return float(np.abs(values).max())

    def doubling(self, response: PeriodicResponse) -> float:
        """Return the frequency [rad/s] near a response at which a multiplier is -1."""
        return float(self._with_multiplier(response, -1.0)[1])

    def fold(self, response: PeriodicResponse) -> tuple[float, float]:
        """Return frequency [rad/s] and first harmonic [m] of the fold near a response.

        A multiplier is 1 there.
        """
        phase, *unknown = self._with_multiplier(response, 1.0)
        return float(unknown[0]), self.amplitude(np.array(unknown), float(phase))

    def _with_multiplier(self, response: PeriodicResponse, value: float) -> Array:
        """Return phase and unknowns of the motion near a response with a multiplier.

        That is 1 or -1.
        """
        phase, unknown = self.near(response)

        def missed(state: Array) -> Array:
            omega, share, _ = state[1:]
            on, off = self.period(omega, share * 2.0 * np.pi / omega)
            carried = off[:2, :2] @ on[:2, :2]
            excess = 1.0 - value * np.trace(carried) + np.linalg.det(carried)
            return np.append(self.missed(state[1:], state[0]), excess)

        exact = root(missed, np.append(phase, unknown), tol=1e-13).x
        assert np.abs(missed(exact)).max() < 1e-10
        return np.asarray(exact)

    def at(self, response: PeriodicResponse) -> Array:
        """Return phase and unknowns of the motion at a response's frequency."""
        phase, (omega, *rest) = self.near(response)

        def missed(state: Array) -> Array:
            return self.missed(np.append(omega, state[1:]), float(state[0]))

        exact = root(missed, [phase, *rest], tol=1e-13).x
        assert np.abs(missed(exact)).max() < 1e-10
        return np.array([exact[0], omega, *exact[1:]])

    def start(self, unknown: Array, phase: float) -> Start:
        """Return the state of a motion where the drive's sine goes up through zero."""
        omega, share, speed = unknown
        begin = np.array([GAP, speed * GAP * omega, np.cos(phase), np.sin(phase), 1.0])
        touching = share * 2.0 * np.pi / omega
        left = (2.0 * np.pi - phase) / omega
        state = self.carried(omega, min(left, touching), touching=True) @ begin
        if left > touching:
            state = self.carried(omega, left - touching, touching=False) @ state
        return Start(state[:1], state[1:2])

    def near(self, response: PeriodicResponse) -> tuple[float, Array]:
        """Return the phase of first touch, and the unknowns, of about a response."""
        phase = np.linspace(0.0, 2.0 * np.pi, 100_001)
        orders = np.arange(1, len(response.coefficients) // 2 + 1)[:, None]
        cosines, sines = response.coefficients[1::2, 0], response.coefficients[2::2, 0]
        waves = np.cos(orders * phase), np.sin(orders * phase)
        moved = response.coefficients[0, 0] + cosines @ waves[0] + sines @ waves[1]
        speed = (orders[:, 0] * sines) @ waves[0] - (orders[:, 0] * cosines) @ waves[1]
        on = moved > GAP
        first = int(np.flatnonzero(on & ~np.roll(on, 1))[0])
        return float(phase[first]), np.array(
            [response.frequency, on.mean(), speed[first] / GAP]
        )

    def amplitude(self, unknown: Array, phase: float) -> float:
        """Return the first harmonic [m] of a motion, by Simpson's rule."""
        omega, share, speed = unknown
        state = np.array([GAP, speed * GAP * omega, np.cos(phase), np.sin(phase), 1.0])
        period, wave, begin = 2.0 * np.pi / omega, 0.0j, 0.0
        for touching, part in ((True, share), (False, 1.0 - share)):
            times = np.linspace(0.0, part * period, 513)
            step = self.carried(omega, float(times[1]), touching=touching)
            moved = [state[0]]
            for _ in times[1:]:
                state = step @ state
                moved.append(state[0])
            turned = np.exp(-1j * omega * (begin + times))
            wave += simpson(np.array(moved) * turned, x=times)
            begin += part * period
        return float(2.0 / period * abs(wave))

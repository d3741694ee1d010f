"""Oscillators with dry and elastic friction, an Iwan joint, a quadratic damper."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from scipy.optimize import brentq

import microslip
from microslip_mechanics.results.response import PeriodicResponse
from references.curves import curve, first, oscillator, point
from references.finding import Finding

DRY = "Den Hartog (1931), Trans. ASME 53, APM-53-9: motion without stops"
ELASTIC = "Caughey (1960), J. Appl. Mech. 27, 640-643: one harmonic"
AREA = "Masing's loop: 4 R (X - R/k_t)"
JOINT = "Segalman (2005), J. Appl. Mech. 72, 752-760: dissipation in microslip"
WATER = "Jacobsen (1930), Trans. ASME 52, APM-52-15: equal energy, one harmonic"
FORCE, LIMIT, STIFF = 1.0, 0.4, 4.0
QUADRATIC = 0.3


def findings() -> Iterator[Finding]:
    """Yield what is known of them."""
    yield from _dry()
    yield from _elastic()
    yield _joint()
    yield _quadratic()


def _dry() -> Iterator[Finding]:
    """Yield the largest displacement and the loss; both converge as 1/H."""
    threshold = 1e-5
    law = microslip.RegularisedCoulomb(load=LIMIT, mu=1.0, threshold_velocity=threshold)
    problem = oscillator(law, drive=FORCE)
    for frequency in (0.7, 1.3):
        response = point(problem, frequency, 255, 8192)
        highest = _largest(response)
        known = den_hartog(frequency)
        quantity = f"amplitude at {frequency:g} rad/s [m]"
        yield Finding("dry friction", quantity, DRY, known, highest, 6e-4)
        loss = 4.0 * LIMIT * known
        quantity = f"dissipated energy at {frequency:g} rad/s [J]"
        found = response.friction_energy
        yield Finding("dry friction", quantity, DRY, loss, found, 6e-4)


def _largest(response: PeriodicResponse) -> float:
    """Return the largest displacement of a period [m]."""
    displacement, _ = response.at(np.linspace(0.0, 2.0 * math.pi, 4097))
    return float(np.abs(displacement).max())


def den_hartog(frequency: float) -> float:
    """Return the largest displacement [m] of a mass of one on a spring of one."""
    share = 1.0 / (1.0 - frequency**2)
    turn = math.pi / frequency
    decay = math.sin(turn) / (frequency * (1.0 + math.cos(turn)))
    return math.sqrt((FORCE * share) ** 2 - (LIMIT * decay) ** 2)


def _elastic() -> Iterator[Finding]:
    """Yield a sliding Jenkins element's amplitude and loop area."""
    problem = oscillator(
        microslip.Jenkins(stiffness=STIFF, limit=LIMIT), damping=0.05, drive=0.6
    )
    points = curve(problem, 0.8, 2.2, 1, 4096)
    response = max(points, key=first)
    known = _jenkins_amplitude(response.frequency, first(response))
    quantity = f"amplitude at {response.frequency:.4f} rad/s [m]"
    yield Finding("Jenkins oscillator", quantity, ELASTIC, known, first(response), 2e-6)
    area = 4.0 * LIMIT * (known - LIMIT / STIFF)
    found = response.friction_energy
    yield Finding("Jenkins oscillator", "loop area [J]", AREA, area, found, 2e-6)


def _jenkins_amplitude(frequency: float, near: float) -> float:
    """Return the amplitude at which the describing function balances the drive."""

    def unbalanced(amplitude: float) -> float:
        turn = math.acos(1.0 - 2.0 * LIMIT / (STIFF * amplitude))
        spring = STIFF / math.pi * (turn - 0.5 * math.sin(2.0 * turn))
        damper = STIFF / math.pi * math.sin(turn) ** 2
        dynamic = complex(1.0 + spring - frequency**2, 0.05 * frequency + damper)
        return abs(dynamic) * amplitude - 0.6

    return float(brentq(unbalanced, 0.99 * near, 1.01 * near, xtol=1e-14))


def _joint() -> Finding:
    """Return the energy that a joint in microslip dissipates per period."""
    law = microslip.Iwan(
        slip_force=10.0, stiffness=2e3, chi=-0.6, beta=0.2, sliders=40, smallest=1e-3
    )
    problem = oscillator(law, stiffness=2e4, drive=1.0)
    response = point(problem, 100.0, 1, 4096)
    power = law.density * first(response) ** (law.chi + 3.0)
    known = 4.0 * power / ((law.chi + 2.0) * (law.chi + 3.0))
    found = response.friction_energy
    return Finding("Iwan joint", "dissipated energy [J]", JOINT, known, found, 1e-2)


def _quadratic() -> Finding:
    """Return the resonant amplitude with a damper of square law."""
    problem = oscillator(microslip.QuadraticDamper(QUADRATIC), drive=0.2)
    points = curve(problem, 0.8, 1.2, 1, 4096)
    peak = next(each for each in points if each.event == "peak")
    found, frequency = first(peak), peak.frequency

    def unbalanced(amplitude: float) -> float:
        damper = 8.0 / (3.0 * math.pi) * QUADRATIC * frequency**2 * amplitude
        return abs(complex(1.0 - frequency**2, damper)) * amplitude - 0.2

    known = float(brentq(unbalanced, 0.9 * found, 1.1 * found, xtol=1e-14))
    return Finding(
        "quadratic damper", "resonant amplitude [m]", WATER, known, found, 1e-10
    )

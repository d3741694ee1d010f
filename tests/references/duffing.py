"""Duffing's oscillator: peak, folds, backbone and multipliers."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import scipy.special
from scipy.optimize import brentq

import microslip
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import modes_in_range, nonlinear_mode
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from references.curves import curve, first, oscillator
from references.finding import Finding

CUBIC, DAMPING, DRIVE = 0.5, 0.1, 0.25
NAME = "Duffing oscillator"
FORCED = "Kovacic, Brennan (2011), The Duffing Equation, Wiley, ch. 5: one harmonic"
FREE = "Nayfeh, Mook (1979), Nonlinear Oscillations, Wiley, ch. 2: elliptic integral"
FLOQUET = "Liouville's formula: the product is exp(-c T/m)"
PAIR = "Rosenberg (1962), J. Appl. Mech. 29, 7-14: similar modes"


def findings() -> Iterator[Finding]:
    """Yield what is known of it."""
    yield from _forced()
    yield from _free(oscillator(microslip.CubicSpring(CUBIC)), 0, NAME, FREE, CUBIC)
    yield from _free(_pair(), 1, "two masses, cubic coupling", PAIR, 8.0 * CUBIC)


def _forced() -> Iterator[Finding]:
    """Yield the peak and the folds of the curve with one harmonic, and multipliers."""
    problem = oscillator(microslip.CubicSpring(CUBIC), damping=DAMPING, drive=DRIVE)
    points = curve(problem, 0.5, 2.5, 1, 64)
    peak = next(each for each in points if each.event == "peak")
    highest = _highest()
    yield Finding(NAME, "largest amplitude [m]", FORCED, highest, first(peak), 2e-9)
    folds = [each.frequency for each in points if each.event == "fold"]
    names = ("jump down", "jump up")
    for name, known, found in zip(names, _folds(highest), folds, strict=True):
        yield Finding(NAME, f"{name} [rad/s]", FORCED, known, found, 2e-9)
    fine = curve(problem, 0.5, 2.5, 15, 512)
    worst = max(fine, key=lambda each: abs(math.log(_product(each)) - _lost(each)))
    known = math.exp(_lost(worst))
    quantity = "product of multipliers, worst point"
    yield Finding(NAME, quantity, FLOQUET, known, _product(worst), 1e-6)


def _product(response: PeriodicResponse) -> float:
    return float(np.prod(response.multipliers).real)


def _lost(response: PeriodicResponse) -> float:
    return -DAMPING * 2.0 * math.pi / response.frequency


def _highest() -> float:
    """Return the amplitude at which both branches of the curve meet."""
    return math.sqrt(float(brentq(_root, 1e-4, 1e4, xtol=1e-14)))


def _root(square: float) -> float:
    """Return what stands below the root of Ω² at a squared amplitude."""
    stiffness = 1.0 + 0.75 * CUBIC * square
    return DAMPING**4 / 4.0 - DAMPING**2 * stiffness + DRIVE**2 / square


def _folds(highest: float) -> tuple[float, float]:
    """Return where Ω turns on its branch of higher frequencies: jump down, jump up."""

    def slope(square: float) -> float:
        bent = -0.75 * CUBIC * DAMPING**2 - DRIVE**2 / square**2
        return 0.75 * CUBIC + 0.5 * bent / math.sqrt(_root(square))

    squares = np.geomspace(1e-4, highest**2 * (1.0 - 1e-12), 10_001)
    slopes = np.array([slope(each) for each in squares])
    turns = np.flatnonzero(np.diff(np.sign(slopes)))
    found = []
    for place in turns[::-1]:
        square = float(brentq(slope, squares[place], squares[place + 1], xtol=1e-15))
        spring = 1.0 + 0.75 * CUBIC * square - DAMPING**2 / 2.0
        found.append(math.sqrt(spring + math.sqrt(_root(square))))
    down, up = found
    return down, up


def _pair() -> Problem:
    """Return two masses on springs, coupled by a linear and a cubic spring."""
    spring = microslip.CubicSpring(CUBIC)
    return microslip.system(
        names=["x1", "x2"],
        mass=[1.0, 1.0],
        stiffness=[[2.0, -1.0], [-1.0, 2.0]],
        elements=[microslip.Element(spring, between=("x1", "x2"), name="coupling")],
        drive={"x1": 1.0},
    )


def _free(
    problem: Problem, place: int, name: str, source: str, cubic: float
) -> Iterator[Finding]:
    """Yield the natural frequency of a free motion of some amplitude.

    Along the mode the masses obey ü + k u + α u³ = 0, with k the square of the linear
    frequency and α ``cubic``.
    """
    rest = static_equilibrium(problem)
    linear = modes_in_range(problem, rest, 0.1, 10.0)[place]
    options = ModeOptions(1e-3, 2.0, harmonics=15, tolerance=1e-10)
    mode = list(nonlinear_mode(problem, rest, linear, options))[-1]
    displacement, velocity = mode.state(0.0)
    spring = linear.frequency**2
    energy = 0.5 * velocity[0] ** 2 + 0.5 * spring * displacement[0] ** 2
    energy += 0.25 * cubic * displacement[0] ** 4
    square = (math.sqrt(spring**2 + 4.0 * cubic * energy) - spring) / cubic
    stiffest = spring + cubic * square
    modulus = cubic * square / (2.0 * stiffest)
    known = math.pi * math.sqrt(stiffest) / (2.0 * float(scipy.special.ellipk(modulus)))
    quantity = f"frequency at amplitude {math.sqrt(square):.2f} m [rad/s]"
    yield Finding(name, quantity, source, known, mode.frequency, 1e-10)

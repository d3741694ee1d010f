"""The public functions: from a problem to its nonlinear modes (theory §6.8)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hbm.balance.active import moving, symmetric
from hbm.balance.relative_problem import relative_problem
from hbm.continuation.correction import Correction
from hbm.continuation.effort import Effort
from hbm.continuation.leaps import Leaping
from hbm.continuation.step_control import StepControl
from hbm.continuation.tracing import Tracing
from hbm.errors import ContinuationError, placed
from hbm.forces.fourier import derivative
from hbm.modes.free_motion import free_motion
from hbm.modes.linear_modes import FreeDecay, LinearMode, linear_modes
from hbm.modes.modal_parts import Reference
from hbm.modes.modal_resolution import ModalResolution
from hbm.modes.mode_options import ModeOptions
from hbm.one_thread import one_thread
from hbm.resolution.adaptive import AdaptiveBalance
from hbm.structure.condensation import condense
from microslip_mechanics.arrays import Array, ComplexArray, largest
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState

MOST = 63
"""harmonics that are not exceeded"""
SHORTEST = 1e-5
"""arc length below which a gap is passed"""
SHARPEST = 0.9
"""cosine of the sharpest turn in a step: strands of a narrow fold are told apart"""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class NonlinearMode(FreeDecay):
    """A free decaying motion of one amplitude."""

    probes: ComplexArray
    """first harmonic of each probe [m], shape (probes,)"""
    coefficients: Array
    """of the motion u [m], shape (2H + 1, dofs)"""
    frequency_error: float
    """estimated, relative"""
    damping_error: float
    """estimated, of the damping ratio, relative"""
    harmonics: int
    samples: int

    def __repr__(self) -> str:
        """Return what motion it is, in a line."""
        return (
            f"<NonlinearMode: {1e3 * self.amplitude:.4g} mm, "
            f"{self.frequency / math.tau:.6g} Hz, damping ratio {self.damping:.4g}>"
        )

    @property
    def amplitude(self) -> float:
        """Largest of the probes [m]."""
        return largest(self.probes)

    def state(self, phase: float) -> tuple[Array, Array]:
        """Return displacement [m] and velocity [m/s] at a phase, shape (dofs,) each."""
        orders = np.arange(1, len(self.coefficients) // 2 + 1) * phase
        waves = np.ones(len(self.coefficients))
        waves[1::2], waves[2::2] = np.cos(orders), np.sin(orders)
        rates = self.pole.imag * derivative(self.coefficients)
        rates[1:] += self.pole.real * self.coefficients[1:]
        return waves @ self.coefficients, waves @ rates


def modes_in_range(
    problem: Problem, rest: StaticState, lowest: float, highest: float
) -> list[LinearMode]:
    """Return the modes of very small motions with natural frequencies in a range.

    ``rest`` is the static equilibrium; the frequencies are in rad/s.
    """
    relative = relative_problem(problem, rest)
    return linear_modes(problem, relative, lowest, highest)


def nonlinear_mode(
    problem: Problem, rest: StaticState, linear: LinearMode, options: ModeOptions
) -> Iterator[NonlinearMode]:
    """Yield a mode along its amplitude, one per continuation step.

    Parameters
    ----------
    problem
        What moves; its drive is not used.
    rest
        Its static equilibrium.
    linear
        The mode of small motions, from which this one grows.
    options
        Amplitudes and resolution.

    Raises
    ------
    ContinuationError
        If the mode cannot be followed, or not with the effort that is granted; what was
        yielded before stays valid.
    """
    resolution = _resolution(problem, rest, linear, options.largest)
    system = AdaptiveBalance(
        resolution,
        options.first,
        tolerance=options.error if options.harmonics is None else None,
        most=MOST,
        effort=Effort(options.effort),
    )
    control = StepControl(
        tolerance=options.tolerance, smallest=SHORTEST, sharpest_turn=SHARPEST
    )
    with one_thread(), placed(_millimetres):
        start = resolution.start(math.log(options.smallest), system.size)
        end, begin = math.log(options.largest), float(start[-1])
        tracing = Tracing(system, end, begin, resolution.metric, control, system)
        for correction in Leaping(tracing, start):
            yield _mode(problem, rest, resolution, system, correction)
    if correction.point[-1] < end:
        raise ContinuationError(
            f"the mode turns back to {options.smallest:g} m before it reaches "
            f"{options.largest:g} m: more harmonics help, or a smaller range"
        )


def _millimetres(parameter: float) -> str:
    """Return the name of a place along the logarithm of the amplitude."""
    return f"{1e3 * math.exp(parameter):.9g} mm"


def _resolution(
    problem: Problem, rest: StaticState, linear: LinearMode, largest: float
) -> ModalResolution:
    """Return the mode that grows from a linear one, at any resolution.

    ``largest`` is an amplitude [m] that tells which springs bend and which gaps close.
    """
    whole = relative_problem(problem, rest)
    mass = problem.structure.mass
    row = linear.shape.conj() @ mass
    size = float((row @ linear.shape).real)
    # The mode answers to a load like its own inertia, and moves what that reaches.
    inertia = largest * linear.frequency**2 * (mass @ linear.shape)
    load = np.stack([whole.force[0], inertia.astype(complex)])
    loaded = replace(whole, force=load)
    active = moving(loaded, linear.frequency)
    kept, odd = symmetric(active)
    return ModalResolution(
        loaded.restricted(kept, odd),
        active[:, kept],
        free_motion(condense(problem, whole.selection), kept, mass, linear.pole, size),
        Reference(linear.pole, row / size, linear.frequency**2 * size),
        linear,
    )


def _mode(
    problem: Problem,
    rest: StaticState,
    resolution: ModalResolution,
    system: AdaptiveBalance,
    correction: Correction,
) -> NonlinearMode:
    """Return the mode at a settled point."""
    system.persevere()
    point, fourier, error = system.report.kept(correction.point)
    balance = resolution.at(fourier)
    motion, pole = balance.motion(point), balance.unknowns.parts(point).pole
    first = problem.probes.rows @ (motion[1] - 1j * motion[2])
    motion[0] += rest.displacement
    errors, estimate = (error, error), system.estimate
    if estimate is not None and math.isfinite(error):
        errors = resolution.errors(estimate, system.report.corrects)
    return NonlinearMode(
        pole, first, motion, *errors, fourier.harmonics, fourier.samples
    )

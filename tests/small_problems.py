"""Small problems with known answers, and marches of them.

A mass, a mass on a contact, a clamped beam; a whole march in one call, and a dwell of
whole periods whose last one has a first harmonic.
"""

import dataclasses
import itertools

import numpy as np

from contact_tables import contact_points
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.element import Element
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.loads.excitation import Dwell, LoadHistory
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import Beam, Frame, Node
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.system import system
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import Start

STILL = np.zeros((3, 1))
ROWS = 20
"""stored per period of a dwell"""
NORMAL, TANGENT = 0, 1
"""the direction of a contact point along which :func:`mass_on_contact` moves"""


def oscillator(
    *,
    mass: float = 2.0,
    damping: float = 0.5,
    stiffness: float = 300.0,
    preload: float = 0.0,
    drive: float = 1.5,
) -> Problem:
    """Return a mass on spring and damper, without contact; its probe is ``x``."""
    structure = _structure(mass, damping, stiffness)
    contact = Interface(contact_points(0), np.zeros((0, 1)), ())
    return _problem(structure, contact, preload, drive)


def mass_on_contact(
    points: ContactPoints,
    *,
    direction: int,
    mass: float = 2.0,
    damping: float = 0.0,
    stiffness: float = 0.0,
    preload: float = 0.0,
    drive: float = 0.0,
) -> Problem:
    """Return a mass that moves along one direction of a contact; its probe is ``x``."""
    along = np.zeros((3, 1))
    along[direction] = 1.0
    contact = Interface(points, along, ("point",))
    return _problem(_structure(mass, damping, stiffness), contact, preload, drive)


def sliding_block(
    *,
    mass: float = 2.0,
    stiffness: float = 0.0,
    damping: float = 0.0,
    drive: float = 0.0,
    **friction: float,
) -> Problem:
    """Return a block on one point with constant normal load, free to slide."""
    points = contact_points(
        1, stiffness=0.0, damping=0.0, constant_load=True, **friction
    )
    return mass_on_contact(
        points,
        direction=TANGENT,
        mass=mass,
        stiffness=stiffness,
        damping=damping,
        drive=drive,
    )


def rubbing(**changed: float) -> Problem:
    """Return a block on a spring that rubs, its friction turning within many steps."""
    values = {"stiffness": 300.0, "damping": 2.0, "drive": 1.5, "load": 1.0}
    return sliding_block(**{**values, "dynamic": 0.3, "threshold": 0.02, **changed})


def cantilever(
    *, elements: int = 3, mass_damping: float = 20.0, stiffness_damping: float = 2e-5
) -> Problem:
    """Return a steel beam, clamped, without contact, driven across its tip.

    Half a metre long; the first bending modes lie near 33 and 66 Hz. The drive pulls
    along both, so that both answer.
    """
    section = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
    stations = np.linspace(0.0, 0.5, elements + 1)
    nodes = [Node("root", np.zeros(3), ())]
    nodes += [
        Node(f"{place}", np.array([station, 0.0, 0.0]))
        for place, station in enumerate(stations[1:], start=1)
    ]
    beams = tuple(
        Beam(
            start.name,
            end.name,
            section,
            np.array([0.0, 0.0, 1.0]),
            mass_damping,
            stiffness_damping,
        )
        for start, end in itertools.pairwise(nodes)
    )
    frame = Frame(tuple(nodes), beams)
    tip = frame.motion(nodes[-1].name, nodes[-1].position)
    structure = frame.structure()
    return Problem(
        structure,
        Interface(contact_points(0), np.zeros((0, structure.dofs)), ()),
        preload=np.zeros(structure.dofs),
        drive=tip.T @ np.array([0.0, 1.0, 2.0]),
        probes=Probes(("tip y", "tip z"), tip[1:]),
    )


def cubic_oscillator(
    *,
    cubic: float = 1.0,
    damping: float = 0.2,
    stiffness: float = 1.0,
    drive: float = 6.0,
) -> Problem:
    """Return Duffing's oscillator of mass one, its cubic force made by two contacts."""
    facing = np.zeros((6, 1))
    facing[0], facing[3] = 1.0, -1.0
    points = contact_points(2, friction=0, stiffness=cubic, exponent=3.0, damping=0.0)
    contact = Interface(points, facing, ("right", "left"))
    return _problem(_structure(1.0, damping, stiffness), contact, 0.0, drive)


def between_stops() -> Problem:
    """Return a mass between two stiff stops, driven hard."""
    stop = UnilateralSpring(stiffness=20e3, gap=1e-3)
    return system(
        mass=[1.0],
        stiffness=[1000.0],
        damping_ratio=0.01,
        elements=[
            Element(stop, between=("x1", "ground"), name="above"),
            Element(stop, between=("ground", "x1"), name="below"),
        ],
        drive={"x1": 3.0},
    )


def _structure(mass: float, damping: float, stiffness: float) -> Structure:
    one = np.eye(1)
    return Structure(mass * one, damping * one, stiffness * one, ("x",))


def _problem(
    structure: Structure, contact: Interface, preload: float, drive: float
) -> Problem:
    return Problem(
        structure,
        contact,
        preload=np.array([preload]),
        drive=np.array([drive]),
        probes=Probes(("x",), np.eye(1)),
    )


def prescribed(frequency: float, coefficients: Array = STILL) -> PeriodicResponse:
    """Return a motion of which nothing else is known; of one dof at rest if left out.

    Its frequency is in rad/s; the coefficients have the shape ``(2H + 1, dofs)``.
    """
    nothing = np.zeros(0)
    return PeriodicResponse(
        frequency, coefficients, nothing, nothing, 0.0, 0.0, 0.0, "converged", 0
    )


def swinging(amplitude: float, frequency: float, samples: int) -> PeriodicResponse:
    """Return amplitude · sin ωt of a problem with one degree of freedom."""
    made = prescribed(frequency, np.array([[0.0], [0.0], [amplitude]]))
    return dataclasses.replace(made, harmonics=1, samples=samples)


def from_rest(problem: Problem) -> Start:
    """Return a start at rest under the preload."""
    rest = static_equilibrium(problem).displacement
    return Start(rest, np.zeros_like(rest))


def marched(
    problem: Problem,
    history: LoadHistory,
    options: MarchOptions,
    *,
    start: Start | None = None,
    block: float = 0.1,
) -> TimeHistory:
    """Return the response to a load history, its blocks joined."""
    blocks = integrate(problem, history, options, start=start, block=block)
    return joined(list(blocks), "complete")


def dwelled(
    problem: Problem,
    frequency: float,
    *,
    periods: int,
    steps: int,
    start: Start | None = None,
) -> TimeHistory:
    """March whole periods with ``steps`` each, a multiple of :data:`ROWS`."""
    period = 2.0 * np.pi / frequency
    return marched(
        problem,
        Dwell(frequency, periods * period),
        MarchOptions(
            period / steps,
            store_every=steps // ROWS,
            method="reference",
            residual=1e-13,
        ),
        start=start,
        block=periods * period,
    )


def last_harmonic(history: TimeHistory) -> ComplexArray:
    """Return the complex first harmonic of each probe over the last period."""
    phase = 2.0 * np.pi * np.arange(1, ROWS + 1) / ROWS
    cycle = history.displacement[-ROWS:]
    harmonic: ComplexArray = 2.0 / ROWS * (np.exp(-1j * phase) @ cycle.astype(complex))
    return harmonic

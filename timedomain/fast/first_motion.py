"""What the fast march begins with: a motion whose forces balance."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from timedomain.contact.state import State
from timedomain.fast.coordinates import Contacts, Coordinates, Modes
from timedomain.fast.motion import LENGTH, REFERENCE, Control, Motion
from timedomain.record.meters import powers
from timedomain.record.record import FLOWS


def first_motion(
    problem: Problem,
    history: LoadHistory,
    coordinates: Coordinates,
    state: State,
    control: Control,
) -> Motion:
    """Return the motion at time zero, in the coordinates of the march."""
    modes, inverse = coordinates.modes, coordinates.inverse
    reaction = _reaction(coordinates.contacts, state.forces)
    motion = Motion(
        inverse @ state.displacement,
        inverse @ state.velocity,
        _coupled(modes, inverse, state),
        state.gaps,
        state.slips,
        state.forces,
        np.zeros_like(state.forces),
        np.stack([reaction, np.zeros_like(reaction)]),
        _relative(modes, inverse, state),
        powers(problem, history, state),
        np.zeros(len(FLOWS)),
        np.zeros(8),
        np.zeros(11, dtype=np.int64),
    )
    motion.numbers[LENGTH] = control.longest
    motion.numbers[REFERENCE] = control.least
    return motion


def _reaction(contacts: Contacts, forces: Array) -> Array:
    """Return φ from the forces of the points."""
    reaction = np.zeros(int((contacts.first + contacts.width).max(initial=0)))
    for first, width, basis, force in zip(
        contacts.first, contacts.width, contacts.basis, forces, strict=True
    ):
        reaction[first : first + width] += force @ basis[:, :width]
    return reaction


def _coupled(modes: Modes, inverse: Array, state: State) -> Array:
    """Return the damping force of the other modes, its rate and 0, (3, modes)."""
    if not modes.coupling.any():
        return np.zeros((3, 0))
    motion = np.stack([state.velocity, state.acceleration])
    return np.pad(motion @ inverse.T @ modes.coupling.T, ((0, 1), (0, 0)))


def _relative(modes: Modes, inverse: Array, state: State) -> Array:
    """Return y and ẏ, shape (2, rank)."""
    motion = np.stack([state.displacement, state.velocity], axis=1)
    return np.ascontiguousarray((modes.selection @ inverse @ motion).T)

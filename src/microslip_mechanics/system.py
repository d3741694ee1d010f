"""Any structure with any elements: from matrices and names to a Problem."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.element import Element, interface_of
from microslip_mechanics.loads.base_motion import BaseMotion
from microslip_mechanics.loads.engine_order import EngineOrder
from microslip_mechanics.loads.given_loads import Drive, driven, preloaded
from microslip_mechanics.loads.node_sets import Sets, given_sets
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structures.damping import Damping
from microslip_mechanics.structures.forms import (
    Form,
    Pair,
    form,
    is_name,
    relative,
)
from microslip_mechanics.structures.given_matrices import (
    check_like,
    check_massive,
    dof_names,
    square_matrix,
)
from microslip_mechanics.structures.gyroscopic import turning
from microslip_mechanics.structures.structure import Structure

ProbeForms: TypeAlias = Sequence[str] | Mapping[str, Form | Pair]
"""degrees of freedom, or names with a form or a pair of ends each"""
MANY = 12
"""so many degrees of freedom are all probes unless others are named"""


def system(
    *,
    mass: ArrayLike | Matrix,
    stiffness: ArrayLike | Matrix,
    damping: ArrayLike | Matrix | None = None,
    damping_ratio: float | Sequence[float] | Array | None = None,
    rayleigh_damping: Sequence[float] | Array | None = None,
    loss_factor: float | None = None,
    gyroscopic: ArrayLike | Matrix | None = None,
    names: Sequence[str] | None = None,
    elements: Iterable[Element] | None = None,
    drive: Drive | None = None,
    preload: Mapping[str, float] | None = None,
    engine_order: EngineOrder | None = None,
    base: BaseMotion | None = None,
    probes: ProbeForms | None = None,
    sets: Sets | None = None,
) -> Problem:
    """Return a structure with its elements and loads as a problem for the solvers.

    Parameters
    ----------
    mass, stiffness, damping
        M [kg], K [N/m], C [N s/m]: arrays, sparse matrices, or one axis for a diagonal.
    damping_ratio
        Of all modes, in place of C; or a list for the slowest modes, faster ones then
        being damped more, in proportion to their frequency.
    rayleigh_damping
        α [1/s] and β [s] of C = α M + β K, in place of C.
    loss_factor
        η of the stiffness, in place of C: the ratio η/2 of all modes, the same at
        resonance and nowhere off by more than η (:func:`~microslip_mechanics.\
structures.hysteretic.equivalent_viscous`).
    gyroscopic
        G [N s/m], skew-symmetric, beside any of these: M ü + (C + G) u̇ + K u = p.
    names
        Of the degrees of freedom; x1, x2, … if left out.
    elements
        Laws and where they act.
    drive
        Amplitude [N] of p sin(ωt + φ) by degree of freedom, or amplitude and φ [rad].
    preload
        Static forces [N].
    engine_order, base
        More harmonic forces: a wave around a disk, ground that moves.
    probes
        What results report; every degree of freedom, if there are few.
    sets
        Nodes by the name of their set; ``set.direction`` in drive and preload is a
        load on each of them.

    Raises
    ------
    ValueError
        In one line, with what is wrong and what to give instead.
    """
    masses, elastic = (
        square_matrix(mass, "mass"),
        square_matrix(stiffness, "stiffness"),
    )
    known = dof_names(names, masses.shape[0])
    groups = given_sets(sets, known)
    check_like(elastic, masses, "stiffness")
    check_massive(masses, known)
    lossy = Damping(damping, damping_ratio, rayleigh_damping, loss_factor)
    structure = Structure(masses, lossy.of(masses, elastic, known), elastic, known)
    if gyroscopic is not None:
        structure = turning(structure, gyroscopic)
    return Problem(
        structure,
        interface_of(() if elements is None else elements, known),
        preload=preloaded({} if preload is None else preload, known, groups),
        drive=driven(
            {} if drive is None else drive, structure, groups, engine_order, base
        ),
        probes=_probes(probes, known),
    )


def _probes(given: ProbeForms | None, names: tuple[str, ...]) -> Probes:
    """Return what results report."""
    if given is None:
        if len(names) > MANY:
            raise ValueError(
                f"there are {len(names)} degrees of freedom: name the probes, which "
                "results report"
            )
        given = names
    if (
        not isinstance(given, (Mapping, Sequence))
        or isinstance(given, str)
        or not given
    ):
        raise ValueError(f"probes = {given!r}: give the names of one or more")
    if not isinstance(given, Mapping):
        listed = [str(name) for name in given]
        if len(set(listed)) < len(listed):
            twice = max(listed, key=listed.count)
            raise ValueError(
                f"probes: {twice} stands there more than once: give it once"
            )
        given = {str(name): name for name in given}
    rows = [_probe(name, wanted, names) for name, wanted in given.items()]
    return Probes(tuple(given), np.array(rows))


def _probe(name: str, wanted: Form | Pair, names: tuple[str, ...]) -> Array:
    """Return what a probe sees of the motion, shape (dofs,)."""
    what = f"probe {name}"
    if not is_name(name):
        raise ValueError(f"probe {name!r}: give a text of one line as its name")
    if isinstance(wanted, (str, Mapping)):
        row = form(wanted, names, what)
    else:
        row = relative(wanted, names, what)
    if not row.any():
        raise ValueError(f"{what} never moves: give a degree of freedom")
    return row

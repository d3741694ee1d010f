"""Structural damping: a loss factor of the stiffness."""

from __future__ import annotations

from microslip_mechanics.structures.modal_damping import ModalDamping


def equivalent_viscous(loss_factor: float, modes: int) -> ModalDamping:
    """Return viscous damping that equals K (1 + i η) at the first resonances.

    K (1 + i η) at each positive frequency has no counterpart in time: its response to
    an impulse begins before the impulse (Crandall 1970), and a solver of differential
    equations cannot march it. So that all solvers speak of the same structure, they are
    given viscous damping with the ratio η/2 in each mode instead.

    At a frequency of r times that of a mode this changes the mode's response by
    η |1 − r|/|1 − r² + i η r|, relative: zero at resonance, nowhere more than
    η/(1 + r). Responses of all modes together differ by no more than the largest of
    these, as a norm weighted with the mass.

    Raises
    ------
    ValueError
        If the loss factor η is not from 0 to below 1.
    """
    if not 0.0 <= loss_factor < 1.0:
        raise ValueError(f"loss factor {loss_factor:g}: give one from 0 to below 1")
    return ModalDamping((0.5 * loss_factor,) * modes)

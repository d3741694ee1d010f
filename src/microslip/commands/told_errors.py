"""What a curve tells of its errors on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from microslip.commands.columns import force, span

if TYPE_CHECKING:
    from microslip.scenes.scene import Scene
    from microslip_mechanics.results.response_curve import ResponseCurve


FAINT = 1e-9
"""of the largest energy or force, up to which others are nothing but rounding"""


def told_errors(scene: Scene, curve: ResponseCurve) -> list[str]:
    """Return how accurate the curve of a scene is, and what that does not count."""
    return [amplitude(curve), *contacts(curve), *_uncounted(scene)]


def amplitude(curve: ResponseCurve) -> str:
    """Return how accurate the curve is, and with how many harmonics."""
    import numpy as np

    known = 100.0 * curve.error[np.isfinite(curve.error)]
    lost = curve.error.size - known.size
    error = (
        f"at most {known.max():.2g} % at a point, {float(np.median(known)):.2g} % in "
        "the median"
        if known.size
        else "not known"
    )
    if known.size and lost:
        error += f", not known at {lost} of {curve.error.size} points"
    return (
        f"estimated error of amplitude: {error}; "
        f"{span(curve.harmonics, 'harmonic')}, {span(curve.samples, 'sample')}"
    )


def contacts(curve: ResponseCurve) -> list[str]:
    """Return how accurate energies and forces of the contacts are, a line each."""
    import numpy as np

    lines = []
    least = FAINT * curve.contact_energy.max(initial=0.0)
    for what, taken, error in (
        ("friction", curve.friction_energy, curve.friction_energy_error),
        ("damping", curve.damping_energy, curve.damping_energy_error),
    ):
        most, known = abs(taken).max(initial=0.0), error[np.isfinite(error)]
        if most <= least or not known.size:
            continue
        largest, middle = 100.0 * known.max() / most, 100.0 * np.median(known) / most
        lines.append(
            f"estimated error of what {what} takes out: at most {largest:.2g} % of its "
            f"largest, {middle:.2g} % in the median"
        )
    worst = curve.normal_error.max(axis=1, initial=0.0)
    known = worst[np.isfinite(worst)]
    if known.max(initial=0.0) > FAINT * curve.normal_largest.max(initial=0.0):
        lines.append(
            f"estimated error of {force(pulls=curve.pulls)}s: at most "
            f"{known.max():.2g} N, {np.median(known):.2g} N in the median"
        )
    return lines


def _uncounted(scene: Scene) -> list[str]:
    """Return what of a scene's model these errors do not count, a line each."""
    from microslip.scenes.bladed_disk.tables import BladedDisk
    from microslip.scenes.two_blades.tables import TwoBlades

    if isinstance(scene.rig, TwoBlades | BladedDisk):
        return []
    from microslip_mechanics.laws.iwan import Iwan

    lines = []
    reduction = scene.rig.structure.reduction
    if reduction is not None:
        lines.append(
            f"not in these errors: the reduction to modes up to {reduction.highest:g} "
            "Hz, beyond which harmonics may lie, and without which peaks may lie "
            "elsewhere: microslip explain tells by how much; see whether the curve "
            "changes with a higher structure.reduction.highest"
        )
    for name, law in scene.rig.element.items():
        if isinstance(law, Iwan):
            lines.append(
                f"not in these errors: element {name} is {law.sliders} sliders, whose "
                f"force is up to {law.backbone_error:.1e} of slip_force above its "
                f"law's: more of them, or a smaller element.{name}.smallest, are "
                "nearer to it"
            )
    return lines

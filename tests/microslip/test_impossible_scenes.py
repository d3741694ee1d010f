"""Values that the reader accepts and physics does not: a result, or one clear line."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest

Run: TypeAlias = Callable[..., tuple[int, str, str]]

SLOW = ("friction.mu_dynamic=1e10",)
"""sweeps that take long"""
IMPOSSIBLE = [
    "preload.force=0",
    "preload.force=1e-300",
    "preload.force=1e6",
    "preload.force=1e300",
    "preload.offset=1",
    "excitation.force=1e-300",
    "excitation.force=1e9",
    "excitation.force=1e300",
    "excitation.offset=1",
    "contact.sigma=1e-160",
    "contact.sigma=1e-30",
    "contact.sigma=1e30",
    "contact.sigma=1e200",
    "contact.exponent=1",
    "contact.exponent=10",
    "contact.damping_ratio=10",
    "contact.damping_exponent=10",
    "contact.angle_excited=1e-12",
    "contact.angle_excited=1.2",
    "friction.threshold_velocity=1e-300",
    "friction.threshold_velocity=1e300",
    "friction.mu_dynamic=0",
    "friction.mu_dynamic=1e10",
    "friction.mu_dynamic=1e300",
    "friction_element.mass=1e-30",
    "friction_element.mass=1e30",
    "friction_element.mass=1e300",
    "friction_element.inertia_x=1e300",
    "friction_element.height=1e-12",
    "blade_end.mass=0",
    "blade_end.mass=1e300",
    "rope.stiffness=0",
    "rope.stiffness=1e15",
    "rope.stiffness=1e300",
    "blade.mass_damping=1e300",
    "blade.stiffness_damping=1",
    "blade.length=1e-300",
    "blade.length=1e-9",
    "blade.length=10",
    "blade.width=1e-12",
    "blade.thickness=1e-300",
    "blade.elements=1",
    "march.time_step=1",
    "march.store_every=1000",
]
"""overrides"""


def sets(*overrides: str) -> list[str]:
    """Return the arguments that override values of a scene."""
    return [f"--set={each}" for each in overrides]


def check_result_or_one_line(ended: tuple[int, str, str]) -> None:
    status, output, error = ended
    if status == 0:
        assert error == ""
        assert "nan" not in output
    else:
        assert status in (1, 2)
        assert error.startswith("microslip: ")
        assert len(error.splitlines()) == 1
        assert "nan" not in error


@pytest.mark.usefixtures("no_hang", "no_picture")
@pytest.mark.parametrize("override", IMPOSSIBLE)
def test_curve_of_an_impossible_rig_ends_with_a_result_or_one_line(
    override: str, run: Run, quick_scene: Path
) -> None:
    ended = run("frc", str(quick_scene), *sets("model=full", override))

    check_result_or_one_line(ended)


@pytest.mark.usefixtures("no_hang", "no_picture")
@pytest.mark.parametrize(
    "override",
    [
        pytest.param(each, marks=[pytest.mark.long] * (each in SLOW))
        for each in IMPOSSIBLE
    ],
)
def test_sweep_of_an_impossible_rig_ends_with_a_result_or_one_line(
    override: str, run: Run, quick_scene: Path
) -> None:
    ended = run("sweep", str(quick_scene), *sets("model=full", override))

    check_result_or_one_line(ended)


@pytest.mark.usefixtures("no_hang", "no_picture")
@pytest.mark.parametrize("law", ["gkf", "none"])
@pytest.mark.parametrize(
    "override",
    [
        "stribeck_velocity=1e-300",
        "stribeck_exponent=1e-300",
        "viscous=1e300",
        "mu_static=1e300",
        "mu_static=0",
    ],
)
def test_friction_of_no_material_ends_with_a_result_or_one_line(
    law: str, override: str, run: Run, quick_scene: Path
) -> None:
    arguments = (str(quick_scene), *sets(f"friction.law={law}", f"friction.{override}"))

    check_result_or_one_line(run("frc", *arguments))
    check_result_or_one_line(run("sweep", *arguments))


@pytest.mark.usefixtures("no_hang")
@pytest.mark.parametrize("model", ["full", "B", "A"])
def test_curve_without_excitation_has_a_result_and_a_picture(
    model: str, run: Run, quick_scene: Path
) -> None:
    arguments = sets("excitation.force=0", f"model={model}")

    ended = run("frc", str(quick_scene), *arguments)

    assert ended[0] == 0
    check_result_or_one_line(ended)


@pytest.mark.usefixtures("no_hang")
def test_sweep_without_excitation_and_preload_has_a_result_and_a_picture(
    run: Run, quick_scene: Path
) -> None:
    arguments = sets("excitation.force=0", "preload.force=0")

    ended = run("sweep", str(quick_scene), *arguments)

    assert ended[0] == 0
    check_result_or_one_line(ended)


@pytest.mark.usefixtures("no_hang", "no_picture")
def test_time_step_that_fills_the_memory_ends_with_one_line(
    run: Run, quick_scene: Path
) -> None:
    status, _, error = run("sweep", str(quick_scene), *sets("march.time_step=1e-14"))

    assert status in (1, 2)
    assert len(error.splitlines()) == 1


@pytest.mark.slow(seconds=30)
@pytest.mark.usefixtures("no_picture")
def test_curve_of_as_many_harmonics_as_a_scene_may_have_ends(
    run: Run, quick_scene: Path
) -> None:
    arguments = sets("curve.harmonics=255", "curve.samples=2048")

    ended = run("frc", str(quick_scene), *arguments)

    check_result_or_one_line(ended)

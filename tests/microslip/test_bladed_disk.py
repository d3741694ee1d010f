"""The scene bladed-disk: one sector, the whole disk, mistuning, refusals."""

from pathlib import Path

import numpy as np
import pytest

from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of, sector_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import Wanted, trace_curve, trace_sector
from microslip_mechanics.arrays import Array
from microslip_mechanics.cyclic import CyclicProblem

SMALL = ("sectors=6", "drive.engine_order=1", "curve.lowest=140", "curve.highest=200")
FIXED = ("curve.harmonics=3", "curve.samples=240")
WHOLE = "solve=disk"


def scene_of(*overrides: str) -> Scene:
    return load_scene("bladed-disk", [*SMALL, *overrides])


def sector(scene: Scene) -> CyclicProblem:
    made = sector_of(scene)
    assert made is not None
    return made


def highest(scene: Scene) -> tuple[float, float]:
    """Return frequency and amplitude of the highest peak of the first tip."""
    if scene.rig.solve == "sector":
        curve = trace_sector(sector(scene), scene.curve).curve
    else:
        curve = trace_curve(problem_of(scene), scene.curve).curve
    assert curve.ending == "complete"
    peaks = [place for place, event in enumerate(curve.event) if event == "peak"]
    place = max(peaks, key=lambda each: curve.amplitude[each, 0])
    return float(curve.frequency[place]), float(curve.amplitude[place, 0])


@pytest.mark.parametrize(
    ("law", "limit"),
    [pytest.param("jenkins", "1 N", marks=pytest.mark.long), ("coulomb", "0.1 N")],
)
def test_sector_and_disk_have_the_same_curve(law: str, limit: str) -> None:
    middle = ("curve.lowest=150", "curve.highest=165")
    friction = (f"friction.law={law}", f"friction.limit={limit}", *middle)
    one, whole = scene_of(*FIXED, *friction), scene_of(*FIXED, *friction, WHOLE)
    curve = trace_sector(sector(one), one.curve).curve
    other = trace_curve(problem_of(whole), whole.curve).curve
    assert curve.friction_energy[-1] > 0.0  # it slides there
    for end in (0, -1):  # at the same frequency
        assert curve.frequency[end] == other.frequency[end]
        expected = np.full(6, curve.amplitude[end, 0])
        assert other.amplitude[end] == pytest.approx(expected, rel=1e-6)
        energy = curve.friction_energy[end]
        assert energy == pytest.approx(other.friction_energy[end], rel=1e-5, abs=1e-12)


@pytest.mark.long
def test_a_disk_driven_in_phase_is_linear_and_has_one_peak() -> None:
    scene = scene_of("drive.engine_order=6", WHOLE)

    curve = trace_curve(problem_of(scene), scene.curve).curve

    assert curve.ending == "complete"
    assert [event for event in curve.event if event] == ["peak"]


def test_stuck_tips_are_springs() -> None:
    scene = scene_of("friction.limit=1e6")
    frequency, amplitude = highest(scene)
    numbers = scene.rig
    angle = 2.0 * np.pi * numbers.drive.engine_order / numbers.sectors
    stiffness = elastic(scene)
    stiffness[0, 0] += 2.0 * numbers.sector.coupling * (1.0 - np.cos(angle))
    elsewhere = stiffness.copy()
    spring = 2.0 * numbers.friction.stiffness * (1.0 - np.cos(angle))
    elsewhere[3, 3] += spring
    dynamic = elsewhere - frequency**2 * np.diag(numbers.sector.masses)
    dynamic = dynamic + 1j * frequency * numbers.sector.stiffness_damping * stiffness
    load = np.array([0.0, 0.0, 0.0, numbers.drive.amplitude])
    expected = np.linalg.solve(dynamic, load)[3]
    assert amplitude == pytest.approx(abs(expected), rel=1e-6)


def elastic(scene: Scene) -> Array:
    """Return the stiffness of a sector and its spring to the ground alone."""
    one, two, three = scene.rig.sector.springs
    return np.array(
        [
            [one + scene.rig.sector.ground, -one, 0.0, 0.0],
            [-one, one + two, -two, 0.0],
            [0.0, -two, two + three, -three],
            [0.0, 0.0, -three, three],
        ]
    )


def test_mistuning_has_its_deviation_and_comes_back_with_its_seed() -> None:
    many = ("sectors=200", WHOLE, "mistuning.deviation=0.03")
    one, again, other, tuned = (
        np.diag(problem_of(scene_of(*values)).structure.stiffness)[3::4]
        for values in (many, many, (*many, "mistuning.seed=2"), many[:2])
    )
    assert np.array_equal(one, again)
    assert not np.array_equal(one, other)
    assert np.std(one / tuned - 1.0) == pytest.approx(0.03, rel=0.15)
    assert abs(np.mean(one / tuned - 1.0)) < 0.03 * 3.0 / np.sqrt(200.0)


@pytest.mark.long
def test_mistuned_blades_differ() -> None:
    scene = scene_of(*FIXED, WHOLE, "mistuning.deviation=0.02")
    amplitude = trace_curve(problem_of(scene), scene.curve).curve.amplitude
    assert amplitude.shape[1] == 6
    spread = np.ptp(amplitude, axis=1) / amplitude.mean(axis=1)
    assert spread.max() > 0.05


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("mistuning.deviation=0.01", "one sector cannot stand for mistuned ones"),
        ("sector.masses=[1, 2]", "masses has 2 numbers: give 4, for disk, root"),
        ("sector.springs=7", "has 1 number: give 3, for disk to root, root to middle"),
        ("sector.ground=0", "the disk is free"),
        ("solve=blade", "give one of sector, disk"),
        ("sectors=1", "at least 2"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(override: str, message: str) -> None:
    with pytest.raises(SceneError, match=message) as refused:
        scene_of(override)
    assert "\n" not in str(refused.value)


def test_one_sector_has_a_curve_and_nothing_else() -> None:
    scene = scene_of()
    with pytest.raises(SceneError, match=r"explain take one .*: give solve=disk$"):
        problem_of(scene)
    with pytest.raises(SceneError, match="give --set solve=disk"):
        trace_sector(sector(scene), scene.curve, wanted=Wanted(detached=True))
    assert sector_of(scene_of(WHOLE)) is None


def test_the_command_traces_a_sector(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from microslip.cli import main

    target = tmp_path / "sector"
    overrides = [word for each in SMALL for word in ("--set", each)]
    assert main(["frc", "bladed-disk", *overrides, "-o", str(target)]) == 0
    said = capsys.readouterr().out
    assert "peak" in said
    assert "stability is not known: motions of one sector cannot break" in said
    assert target.with_suffix(".nc").stat().st_size > 0
    assert target.with_suffix(".png").stat().st_size > 0

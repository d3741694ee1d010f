"""What is left out of a scene changes nothing: every scene with and without it."""

import functools
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.files.result_file import load
from microslip.scenes.rigs import problem_of, unpruned_of
from microslip.scenes.scene_file import BUILT_IN, load_scene
from microslip.studies.explain.unpruned import (
    Timed,
    difference,
    path_of,
    timed,
    unpruned_path_of,
)
from microslip_mechanics.results.response_curve import ResponseCurve

Run: TypeAlias = Callable[..., tuple[int, str, str]]
BANDS = {
    "two-blades": ("134.6", "134.7"),
    "bladed-disk": ("152", "153"),
    "duffing": ("5.2", "5.3"),
    "jenkins": ("17", "17.2"),
    "gap": ("4.85", "4.9"),
    "nonlinear-absorber": ("0.16", "0.17"),
    "chain": ("0.2", "0.201"),
    "friction-beam": ("80", "81"),
    "tip-damper": ("420", "422"),
    "platform-damper": ("287.8", "288"),
}
"""frequencies [Hz] at which the contacts of each scene slide or lift off"""
RIGS = [
    ("two-blades", f"model={model}", f"friction.law={law}")
    for model in ("A", "B", "full")
    for law in ("coulomb", "gkf")
]
SCENES = [*RIGS, *((name,) for name in BUILT_IN if name != "two-blades")]
COARSE = ("curve.harmonics=5", "curve.samples=96", "sectors=6")


@functools.cache
def both(name: str, *overrides: str) -> tuple[Timed, Timed]:
    """Return a short curve of a scene with and without pruning."""
    lowest, highest = BANDS[name]
    coarse = COARSE if name == "bladed-disk" else COARSE[:2]
    sets = [*coarse, f"curve.lowest={lowest}", f"curve.highest={highest}", *overrides]
    some, every = timed(load_scene(name, sets))
    return some, every


@pytest.mark.parametrize("scene", SCENES, ids="-".join)
def test_the_curve_is_the_same(scene: tuple[str, ...]) -> None:
    some, every = both(*scene)

    one, other = some.curve, every.curve
    assert one.ending == other.ending == "complete"
    # the residual's tolerance is 1e-8 of the loads
    assert difference(some, every) < 1e-6
    sectors = other.amplitude.shape[1] // one.amplitude.shape[1]
    expected = sectors * one.friction_energy[[0, -1]]
    np.testing.assert_allclose(
        other.friction_energy[[0, -1]], expected, rtol=1e-5, atol=1e-12
    )


@pytest.mark.parametrize("model", ["A", "B"])
def test_points_beside_the_one_that_acts_carry_nothing(model: str) -> None:
    some, every = both("two-blades", f"model={model}", "friction.law=coulomb")

    assert every.curve.contacts == ("B1", "B2", "B3", "B4", "A1", "A2", "A3", "A4")
    acts = [every.curve.contacts.index(name) for name in some.curve.contacts]
    for name in ("normal_smallest", "normal_largest"):
        one, other = getattr(some.curve, name), getattr(every.curve, name)
        np.testing.assert_allclose(other[0, acts], one[0], rtol=1e-6)
        assert not np.delete(other, acts, axis=1).any()


def test_without_pruning_the_rig_has_the_unknowns_of_the_full_model() -> None:
    full = unpruned_path_of(load_scene("two-blades"))

    for model in ("A", "B"):
        scene = load_scene("two-blades", [f"model={model}"])
        path, whole = path_of(scene), unpruned_path_of(scene)

        assert whole.rank == full.rank == 12
        assert whole.whole.interface.count == full.whole.interface.count == 8
        assert whole.mask(7).all()
        assert path.mask(7).sum() < whole.mask(7).sum() / 4


def test_the_full_model_is_its_own_unpruned_one() -> None:
    scene = load_scene("two-blades")

    one, other = problem_of(scene).interface, unpruned_of(scene).interface

    np.testing.assert_array_equal(one.displacement, other.displacement)
    for mine, its in zip(one.points, other.points, strict=True):
        np.testing.assert_array_equal(mine, its)


def test_a_curve_that_differs_at_an_end_is_told_apart() -> None:
    some, every = both("duffing")
    changed = every.curve.amplitude.copy()
    changed[-1, 0] += 1e-3 * some.curve.amplitude.max()

    other = replace(every, curve=replace(every.curve, amplitude=changed))

    assert difference(some, other) == pytest.approx(1e-3, rel=1e-3)


def test_curves_of_a_scene_that_nothing_drives_do_not_differ() -> None:
    assert difference(*both("jenkins", "drive.x=0")) == 0.0


def test_a_curve_that_differs_where_it_is_largest_is_told_apart() -> None:
    lowest, highest = "17.5", "19.5"
    sets = [*COARSE[:2], f"curve.lowest={lowest}", f"curve.highest={highest}"]
    some, every = timed(load_scene("jenkins", sets))
    largest = some.curve.amplitude.max()
    weaker = load_scene("jenkins", [*sets, "drive.x=0.4995"])
    other = replace(every, problem=problem_of(weaker))

    assert difference(some, every) < 1e-9 < 1e-4 < difference(some, other)
    assert largest > some.curve.amplitude[[0, -1]].max()


@pytest.mark.usefixtures("no_picture")
def test_frc_draws_the_same_curve_without_pruning(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    for name, more in (("some", []), ("every", ["--unpruned"])):
        status, _, error = run("frc", str(quick_scene), "-o", name, *more)
        assert (status, error) == (0, "")

    some, every = (load(tmp_path / f"{name}.nc").result for name in ("some", "every"))

    assert isinstance(some, ResponseCurve)
    assert isinstance(every, ResponseCurve)
    assert len(some.contacts) == 2
    assert len(every.contacts) == 8
    one, other = (
        np.append(each.amplitude[[0, -1]], each.amplitude.max())
        for each in (some, every)
    )
    np.testing.assert_allclose(other, one, rtol=0.0, atol=1e-6 * one.max())

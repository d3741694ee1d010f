"""Load histories of scenes: the kinds of sweep, their order, what is refused."""

import numpy as np
import pytest

from microslip.scenes.quantity import SceneError
from microslip.scenes.scene_file import load_scene
from microslip.studies.loads import load_history
from microslip.studies.sweep import swept_sine
from microslip_mechanics.loads.segments import clock, factors_over


def of(*words: str) -> tuple[float, np.ndarray]:
    """Return duration of a scene's loads, and their times of change with the clock."""
    history = load_history(
        load_scene("two-blades", [f"sweep.{word}" for word in words])
    )
    segments = history.segments()
    shown = clock(segments, segments.begin + 1e-9)
    hertz = shown[:, 0] / (2.0 * np.pi)
    return history.duration, np.stack([segments.begin, hertz, shown[:, 1]], axis=1)


def test_scene_that_says_nothing_has_the_sweep_of_the_paper() -> None:
    scene = load_scene("two-blades")
    time = np.linspace(0.0, 10.0, 9001)

    factors = factors_over(load_history(scene).segments(), time)

    expected = factors_over(swept_sine(scene.sweep).segments(), time)
    np.testing.assert_allclose(factors, expected, atol=1e-12)


@pytest.mark.parametrize("kind", ["exponential", "linear"])
@pytest.mark.parametrize(
    ("direction", "duration", "expected"),
    [
        ("up", 10.0, [[2, 125, 1], [8, 145, 0]]),
        ("down", 10.0, [[2, 145, 1], [8, 125, 0]]),
        ("up-down", 16.0, [[2, 125, 1], [8, 145, 1], [14, 125, 0]]),
    ],
)
def test_sweeps_go_where_they_are_told(
    kind: str, direction: str, duration: float, expected: list[list[float]]
) -> None:
    length, changes = of(f"kind={kind}", f"direction={direction}")

    assert length == pytest.approx(duration)
    np.testing.assert_allclose(changes[2:], expected, rtol=1e-9)


def test_each_level_has_the_whole_sweep_and_its_free_time() -> None:
    length, changes = of("levels=[0.5, 2]", "direction=up-down")

    assert length == pytest.approx(2.0 + 2 * (12.0 + 2.0))
    np.testing.assert_allclose(changes[2:, 0], [2, 8, 14, 16, 22, 28], rtol=1e-9)
    np.testing.assert_allclose(changes[2:, 1], [125, 145, 125] * 2, rtol=1e-9)
    np.testing.assert_array_equal(changes[2:, 2], [0.5, 0.5, 0, 2, 2, 0])


def test_levels_without_free_time_follow_at_once() -> None:
    _, changes = of("levels=[1, 3]", "duration=8")

    np.testing.assert_allclose(
        changes[2:], [[2, 125, 1], [8, 125, 3], [14, 145, 0]], rtol=1e-9
    )


def test_steps_take_their_periods() -> None:
    words = ("kind=stepped", "steps=3", "periods=100", "direction=up-down")
    length, changes = of(*words)

    hertz = np.array([125.0, 135.0, 145.0, 135.0, 125.0])
    begins = 2.0 + np.cumsum([0.0, *(100.0 / hertz)])
    assert length == pytest.approx(begins[-1] + 2.0)
    np.testing.assert_allclose(changes[2:, 0], begins)
    np.testing.assert_allclose(changes[2:-1, 1], hertz)
    np.testing.assert_array_equal(changes[2:, 2], [1, 1, 1, 1, 1, 0])


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["kind=fast"], "exponential, linear, stepped"),
        (["direction=left"], "up, down, up-down"),
        (["levels=[]"], "is empty"),
        (["levels=[1, 0]"], "above 0"),
        (["levels=[1, true]"], "is not a number"),
        (["kind=stepped", "steps=5"], "periods is missing"),
        (["kind=stepped", "periods=5"], "steps is missing"),
        (["kind=stepped", "periods=5", "steps=1"], "at least 2"),
        (["steps=5"], "only for kind"),
        (["force_file=3"], "is not a text"),
        (["force_file=nowhere.csv"], "there is no force file nowhere.csv"),
        (["force_file=a.csv", "levels=2"], "takes the place of the sine"),
    ],
)
def test_sweep_that_makes_no_sense_is_refused(words: list[str], hint: str) -> None:
    with pytest.raises(SceneError) as caught:
        of(*words)

    assert hint in str(caught.value)
    assert "\n" not in str(caught.value)

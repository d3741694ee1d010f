"""The study of a sweep: the scene's load history, slower ones, parts and wholes."""

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.commands.sweep_tables import estimates
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies.sweep import march_sweep, march_whole, swept_sine
from microslip_mechanics.results.extremes import extremes
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from timedomain.integrate import IntegrationError, integrate

Run: TypeAlias = Callable[..., tuple[int, str, str]]
MARCH = "microslip.studies.sweep.integrate"


@pytest.fixture
def scene(quick_scene: Path) -> Scene:
    """Return a sweep of ten milliseconds."""
    return load_scene(str(quick_scene))


def test_load_history_is_that_of_the_scene() -> None:
    sweep = swept_sine(load_scene("two-blades").sweep)

    assert (sweep.ramp, sweep.start, sweep.end, sweep.duration) == (1.0, 2.0, 8.0, 10.0)
    assert (sweep.lowest, sweep.highest) == (125.0, 145.0)


@pytest.mark.parametrize("slower", [0.5, 1.0, 4.0, 10.0])
def test_slower_sweep_is_longer_between_its_ends_only(slower: float) -> None:
    table = load_scene("two-blades").sweep

    sweep, own = swept_sine(table, slower=slower), swept_sine(table)

    assert (sweep.ramp, sweep.start) == (own.ramp, own.start)
    assert sweep.end - sweep.start == pytest.approx(6.0 * slower)
    assert sweep.duration - sweep.end == pytest.approx(2.0)
    assert sweep.rate == pytest.approx(own.rate / slower)


def test_march_stores_what_the_scene_asks_for(scene: Scene) -> None:
    problem = problem_of(scene)

    history = march_sweep(problem, swept_sine(scene.sweep), scene.march)

    assert history.ending == "complete"
    assert history.time_step == pytest.approx(25e-6)
    np.testing.assert_allclose(np.diff(history.time), 250e-6)
    assert history.time[-1] == pytest.approx(0.01)
    assert history.probes == problem.probes.names
    assert history.contacts == ("B1", "A1")


def test_a_sweep_begins_where_a_preloaded_contact_rests() -> None:
    short = ("sweep.end=0.3", "sweep.duration=0.3", "sweep.start=0.25")
    scene = load_scene("tip-damper", short)
    problem = problem_of(scene)

    history = march_sweep(problem, swept_sine(scene.sweep), scene.march)

    # it had begun with a blow: 20 N at zero displacement, 14 N at rest
    rest = static_equilibrium(problem)
    still = history.time < 0.25
    np.testing.assert_allclose(
        history.normal_force[still],
        np.broadcast_to(rest.normal_force, history.normal_force[still].shape),
        rtol=1e-6,
    )
    assert history.peak_error.size == history.time.size


def test_march_that_stores_rarely_takes_no_shorter_steps(quick_scene: Path) -> None:
    # 400 steps of 25 µs
    scene = load_scene(str(quick_scene), ["march.store_every=10000"])

    history = march_sweep(problem_of(scene), swept_sine(scene.sweep), scene.march)

    assert history.time_step == pytest.approx(25e-6)
    assert history.time == pytest.approx([0.01])


def test_watch_sees_every_block_of_a_march(scene: Scene) -> None:
    seen: list[float] = []

    def watch(blocks):  # type: ignore[no-untyped-def]
        for block in blocks:
            seen.append(block.time[-1])
            yield block

    history = march_sweep(
        problem_of(scene), swept_sine(scene.sweep), scene.march, watch
    )

    assert seen[-1] == history.time[-1]


@pytest.mark.parametrize(
    ("end", "ending"),
    [
        (KeyboardInterrupt(), "interrupted"),
        (IntegrationError("stuck at 3 ms"), "stuck at 3 ms"),
    ],
)
def test_part_of_a_march_is_no_whole(
    end: BaseException,
    ending: str,
    scene: Scene,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def stops(*arguments: object, **named: object) -> Iterator[TimeHistory]:
        yield from integrate(*arguments, **named)  # type: ignore[arg-type]
        raise end

    monkeypatch.setattr(MARCH, stops)
    problem, sweep = problem_of(scene), swept_sine(scene.sweep)

    part = march_sweep(problem, sweep, scene.march)

    assert part.ending == ending
    with pytest.raises(type(end)) as caught:
        march_whole(problem, sweep, scene.march)
    assert str(caught.value) == str(end)


def test_whole_march_is_the_march(scene: Scene) -> None:
    problem, sweep = problem_of(scene), swept_sine(scene.sweep)

    whole = march_whole(problem, sweep, scene.march)

    marched = march_sweep(problem, sweep, scene.march)
    np.testing.assert_array_equal(whole.energy, marched.energy)


@pytest.mark.parametrize(("share", "more"), [(0.1, False), (0.3, True)])
def test_rows_that_are_too_sparse_tell_a_least_error_of_the_peak(
    share: float, *, more: bool, small_history: TimeHistory
) -> None:
    found = extremes(small_history)
    missed = np.stack([(1.0 - share) * found.largest, found.largest])

    *_, line = estimates(small_history, replace(found, halves=missed))

    assert line == (
        f"estimated error of the peak amplitude {share:.1e}{' or more' * more}"
    )


def test_sparser_rows_tell_as_large_extremes_within_their_error(
    run: Callable[..., tuple[int, str, str]],
) -> None:
    def told(every: int) -> tuple[np.ndarray, float]:
        sets = ("sweep.lowest=5", "sweep.end=2", "sweep.duration=2")
        words = [f"--set={each}" for each in (*sets, f"march.store_every={every}")]
        _, output, _ = run("sweep", "gap", *words)
        error = output.split("error of the peak amplitude ")[1].split()[0]
        row = next(line for line in output.splitlines() if line.startswith("  x "))
        return np.array(row.split()[1:], dtype=float), float(error)

    (dense, least), (sparse, error) = told(1), told(40)

    assert least == 1e-3  # of the march alone
    assert abs(sparse[0] / dense[0] - 1.0) <= error < 0.05
    # the rows themselves end 5 % before it
    np.testing.assert_allclose(sparse, dense, rtol=1e-3)


@pytest.mark.usefixtures("no_picture")
def test_a_sweep_tells_what_its_rows_miss_however_many_a_picture_shows(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    keys = ("drive.x=0.5", "sweep.kind=linear", "sweep.start=0", "sweep.end=1")
    stiff = (*keys, "sweep.duration=1", "element.stop.stiffness=1e6")
    words = ("sweep", "gap", *(f"--set={each}" for each in stiff))

    _, whole, _ = run(*words)
    monkeypatch.setattr("microslip.commands.arguments.MOST_ROWS", 100)
    monkeypatch.setattr("microslip.files.result_file.CHUNK", 64)
    _, thinned, _ = run(*words)

    # closing errors between the rows of a picture are not looked at
    assert thinned[thinned.index("estimated") :] == whole[whole.index("estimated") :]
    assert re.search(r"rows may miss \d\d %.* of the largest normal force", whole)

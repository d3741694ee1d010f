"""Fixtures: the command line in this process, small results, a limit on the time."""

import os
import signal
from collections.abc import Callable, Iterator
from pathlib import Path

# before numpy is loaded; workers whose threads wait for each other's cores take long
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.cli import main
from microslip.files.schema import Result
from microslip.scenes.scene_file import built_in_text
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.record.record import FLOWS, STORES

PROBES = ("excited-blade", "follower-blade", "element", "element-to-excited")
CONTACTS = ("B1", "B2", "A1")
QUICK = {
    'model = "full"': 'model = "A"',
    'ramp = "1 s"': 'ramp = "5 ms"',
    'start = "2 s"': 'start = "5 ms"',
    'end = "8 s"': 'end = "10 ms"',
    'duration = "10 s"': 'duration = "10 ms"',
    'lowest = "125 Hz"\nhighest = "145 Hz"': 'lowest = "130 Hz"\nhighest = "130.2 Hz"',
    "tolerance = 1e-3": "harmonics = 1\nsamples = 16\ntolerance = 1e-3",
}
"""what makes the built-in scene quick: model A, a coarse curve, one cycle of a sweep"""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes longest, so that no worker is left alone with it.

    The first two need different machine code, each making what the other uses later.
    """
    items.sort(key=_seconds, reverse=True)


def _seconds(item: pytest.Item) -> float:
    """Return about how long a test takes, as its mark says."""
    slow = item.get_closest_marker("slow")
    return 0.0 if slow is None else float(slow.kwargs.get("seconds", 5.0))


@pytest.fixture
def run(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> Callable[..., tuple[int, str, str]]:
    """Return what runs a command in ``tmp_path``: status, output, error output."""
    monkeypatch.chdir(tmp_path)

    def ran(*arguments: str) -> tuple[int, str, str]:
        capsys.readouterr()
        try:
            status = main(list(arguments))
        except SystemExit as left:  # argparse: --help, wrong usage
            status = int(left.code or 0)
        return status, *capsys.readouterr()

    return ran


@pytest.fixture
def quick_scene(tmp_path: Path) -> Path:
    """Return a copy of the built-in scene in ``tmp_path`` that takes no time."""
    path = tmp_path / "quick.toml"
    path.write_text(_quick(), encoding="utf-8")
    return path


def _quick() -> str:
    text = built_in_text("two-blades")
    for old, new in QUICK.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


@pytest.fixture(scope="session")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Have the machine code of the kernels, whose making takes its time."""
    folder = tmp_path_factory.mktemp("compiled")
    scene = folder / "quick.toml"
    scene.write_text(_quick(), encoding="utf-8")
    for command in ("frc", "sweep"):
        assert main([command, str(scene), "-o", str(folder / command)]) == 0


@pytest.fixture
def no_hang(compiled: None) -> Iterator[None]:  # noqa: ARG001
    """End a test that does not end by itself."""

    def stop(*_: object) -> None:
        raise RuntimeError("the test hangs")

    # time of the processor: a busy machine makes nothing hang
    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, 20.0)
    yield
    signal.setitimer(signal.ITIMER_PROF, 0.0)
    signal.signal(signal.SIGPROF, before)


@pytest.fixture
def no_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out the pictures, which take longest."""

    def undrawn(*_: object) -> None:
        return

    # the first, when it is loaded, takes the second as it is then
    for name in ("figures.result.result_figure", "figures.curve.curve_figure"):
        monkeypatch.setattr(f"microslip.{name}", undrawn)
    monkeypatch.setattr("microslip.files.store.save_figure", undrawn)


@pytest.fixture
def blank_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write pictures with nothing on them, where it does not matter what they show."""

    def blank(*_: object) -> Figure:
        return Figure()

    for name in ("figures.result.result_figure", "figures.curve.curve_figure"):
        monkeypatch.setattr(f"microslip.{name}", blank)


@pytest.fixture
def axes() -> Axes:
    """Return axes without a screen."""
    return Figure().subplots()


@pytest.fixture
def small_curve() -> ResponseCurve:
    """Return a curve of four points whose numbers are all different."""
    draw, points = np.random.default_rng(1), 4
    of_probes = (points, len(PROBES))
    return ResponseCurve(
        frequency=2.0 * np.pi * np.array([130.0, 131.0, 133.0, 134.0]),
        probes=PROBES,
        amplitude=draw.uniform(1e-5, 1e-3, of_probes),
        amplitude_lowest=draw.uniform(1e-7, 1e-5, of_probes),
        amplitude_highest=draw.uniform(1e-3, 2e-3, of_probes),
        peak=draw.uniform(1e-5, 1e-3, of_probes),
        velocity_peak=draw.uniform(1e-3, 1.0, of_probes),
        contacts=CONTACTS,
        normal_smallest=draw.uniform(0.1, 1.0, (points, len(CONTACTS))),
        normal_largest=draw.uniform(1.0, 3.0, (points, len(CONTACTS))),
        friction_energy=draw.uniform(1e-6, 1e-3, points),
        damping_energy=draw.uniform(1e-9, 1e-8, points),
        friction_energy_error=draw.uniform(1e-9, 1e-6, points),
        damping_energy_error=draw.uniform(1e-12, 1e-11, points),
        normal_error=draw.uniform(1e-4, 1e-3, (points, len(CONTACTS))),
        residual=draw.uniform(1e-12, 1e-9, points),
        outcome=("converged",) * points,
        iterations=np.array([7.0, 3.0, 4.0, 5.0]),
        harmonics=np.array([15.0, 7.0, 31.0, 63.0]),
        samples=np.array([128.0, 64.0, 256.0, 512.0]),
        error=draw.uniform(1e-5, 1e-3, points),
        multiplier=draw.uniform(0.9, 1.1, points),
        unstable=np.array([-1.0, 0.0, 1.0, 2.0]),
        event=("", "peak", "fold", ""),
        parameter=2.0 * np.pi * np.array([130.0, 131.0, 133.0, 134.0]),
        parameter_error=np.array([np.nan, 1e-3, 1e-4, np.nan]),
        along="",
        ending="complete",
    )


@pytest.fixture
def small_history() -> TimeHistory:
    """Return a history of six times whose numbers are all different."""
    draw, times = np.random.default_rng(2), 6
    energies = (*FLOWS, *STORES)
    return TimeHistory(
        time=np.linspace(0.1, 0.6, times),
        probes=PROBES,
        displacement=draw.normal(size=(times, len(PROBES))) * 1e-4,
        velocity=draw.normal(size=(times, len(PROBES))),
        contacts=CONTACTS,
        normal_force=draw.uniform(0.0, 3.0, (times, len(CONTACTS))),
        friction_power=draw.uniform(0.0, 1.0, times),
        energies=energies,
        energy=draw.uniform(0.0, 1e-3, (times, len(energies))),
        stored_at_start=1.25e-7,
        time_step=2.5e-5,
        iterations=123,
        divided=4,
        ending="interrupted",
        checkpoint=Checkpoint(draw.normal(size=3), draw.normal(size=3), np.ones(5)),
        frequency=draw.uniform(700.0, 900.0, times),
        level=draw.uniform(0.0, 2.0, times),
        energy_error=draw.uniform(0.0, 1e-5, times),
        peak_error=draw.uniform(0.0, 1e-3, times),
        work_difference=draw.normal(size=times) * 1e-6,
    )


@pytest.fixture
def small_envelope() -> Envelope:
    """Return an envelope of five cycles whose numbers are all different."""
    draw, cycles = np.random.default_rng(3), 5
    energies = (*FLOWS, *STORES)
    return Envelope(
        time=np.linspace(0.1, 0.5, cycles),
        frequency=draw.uniform(700.0, 900.0, cycles),
        level=draw.uniform(0.5, 2.0, cycles),
        probes=PROBES,
        highest=draw.uniform(0.0, 1e-3, (cycles, len(PROBES))),
        lowest=draw.uniform(-1e-3, 0.0, (cycles, len(PROBES))),
        fastest=draw.uniform(0.1, 1.0, (cycles, len(PROBES))),
        contacts=CONTACTS,
        normal_smallest=draw.uniform(0.1, 1.0, (cycles, len(CONTACTS))),
        normal_largest=draw.uniform(1.0, 3.0, (cycles, len(CONTACTS))),
        energies=energies,
        energy=draw.uniform(0.0, 1e-3, (cycles, len(energies))),
        stored_at_start=2.5e-7,
        time_step=2.5e-5,
        iterations=321,
        divided=2,
        ending="interrupted",
        checkpoint=Checkpoint(draw.normal(size=3), draw.normal(size=3), np.ones(6)),
        energy_error=draw.uniform(0.0, 1e-5, cycles),
        peak_error=draw.uniform(0.0, 1e-3, cycles),
        work_difference=draw.uniform(-1e-5, 1e-5, cycles),
    )


@pytest.fixture(params=["curve", "history", "envelope"])
def result(
    request: pytest.FixtureRequest,
    small_curve: ResponseCurve,
    small_history: TimeHistory,
    small_envelope: Envelope,
) -> Result:
    """Return one result of each kind."""
    results: dict[str, Result] = {
        "curve": small_curve,
        "history": small_history,
        "envelope": small_envelope,
    }
    return results[request.param]

"""Easier problems from which a first point is reached."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import hbm.curves.homotopy
from hbm.curves.homotopy import FOURIERS, approaches
from hbm.options import CurveOptions
from hbm.paths.along_share import driven
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import between_stops


@pytest.mark.parametrize(
    ("friction", "stop", "tried"),
    [
        (0.0, False, ["driven"]),
        (0.3, False, ["driven", "_threshold", "_friction"]),
        (0.0, True, ["driven"]),
    ],
)
def test_what_a_problem_has_makes_it_easier(
    friction: float,
    stop: bool,
    tried: list[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found: list[str] = []

    def noted(name: str) -> Callable[..., Array]:
        def made(*_: Any) -> Array:
            found.append(name)
            return np.zeros((1, 1))

        return made

    def yielded(name: Callable[..., str]) -> Callable[..., Iterator[Array]]:
        def made(*given: Any, **options: Any) -> Iterator[Array]:
            found.append(name(*given, **options))
            yield np.zeros((1, 1))

        return made

    def followed(_path: Any, _parameter: Any, easier: Any, *_: Any) -> Array:
        found.append(easier.__name__)
        return np.zeros((1, 1))

    replaced = {
        "_touches": lambda *_: False,
        "stiffening": lambda *_: driven if stop else None,
        "soft": lambda *_: np.array([stop]),
        "followed": followed,
        "fine_arcs": yielded(lambda shares, *_, **__: f"fine {shares.easier.__name__}"),
        "parted": yielded(lambda *_, arcs: f"parted {arcs}"),
        "grown": noted("grown"),
        "along_an_arc": noted("arc"),
    }
    for name, made in replaced.items():
        monkeypatch.setattr(hbm.curves.homotopy, name, made)
    laws = np.array([friction])
    points = SimpleNamespace(dynamic=laws, static=laws)
    problem = SimpleNamespace(points=points, apart=lambda _: np.zeros(3))
    path: Any = SimpleNamespace(at=lambda _: (problem, 1.0))
    nothing: Any = None

    list(approaches(path, 1.0, nothing, nothing, nothing))

    # what may take long comes last, stops before anything else
    stops, all_of = ["driven"] * stop, len(FOURIERS)
    ways = stops * all_of + tried * all_of + ["arc"] * all_of
    assert found == [*ways, "parted 1"]

    found.clear()
    given: Any = object()
    list(approaches(path, 1.0, nothing, nothing, nothing, folded=False, resolved=given))
    stops = ["driven", "fine driven"] * stop
    louder = ["fine _louder"] * (friction > 0.0)
    assert found == [*stops, *tried * all_of, *louder, "grown", "parted 2"]


def test_a_curve_begins_where_its_arc_of_drives_passes_zero() -> None:
    # Above the resonance the response to more drive folds where it meets the stops, and
    # comes back to hardly any drive, on the free motion of this frequency.
    problem = between_stops()
    options = CurveOptions(2.0 * np.pi * 5.5, 2.0 * np.pi * 5.7)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    assert (curve[0].frequency, curve[-1].frequency) == (options.start, options.end)
    assert max(each.error for each in curve) <= options.error


def test_a_curve_begins_at_a_stop_that_just_touches_at_rest() -> None:
    hertz, damping = 5.7, 6.0
    stop = Element(UnilateralSpring(stiffness=1e4), between=("x", "ground"), name="s")
    problem = system(
        names=["x"],
        mass=[1.0],
        stiffness=[1e3],
        damping=[damping],
        elements=[stop],
        drive={"x": 0.1},
    )
    turn = 2.0 * np.pi * hertz
    options = CurveOptions(turn, 1.1 * turn, harmonics=31, stability=False)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    times = (57.0 + np.arange(256) / 256.0) / hertz

    def rate(time: float, state: Array) -> list[float]:
        x, v = state
        force = 0.1 * np.sin(turn * time) - damping * v - 1e3 * x - 1e4 * max(x, 0.0)
        return [v, force]

    marched = solve_ivp(
        rate, (0.0, times[-1]), [0.0, 0.0], t_eval=times, rtol=1e-8, atol=1e-12
    )
    wave = np.exp(-1j * turn * times)
    assert first.frequency == turn
    assert first.seen(problem.probes.rows)[1:3, 0] @ [1.0, -1.0j] == pytest.approx(
        2.0 * np.mean(marched.y[0] * wave), rel=1e-3
    )

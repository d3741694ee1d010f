"""The told error of the largest multiplier, beside the exact one of a stop."""

import math

import numpy as np
import pytest

from hbm.curves.periodic_response import multiplier_error
from hbm.events.multipliers import Multipliers
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.static import static_equilibrium
from struck import GAP, Struck


@pytest.mark.parametrize(
    ("stop", "drive"),
    [
        (1e4, 0.05),
        (2e4, 0.05),
        pytest.param(6e4, 0.05, marks=pytest.mark.long),
        pytest.param(6e4, 0.1, marks=pytest.mark.long),
        pytest.param(1e5, 0.1, marks=pytest.mark.long),
        pytest.param(2e5, 0.05, marks=pytest.mark.long),
    ],
)
def test_the_largest_multiplier_errs_by_no_more_than_is_told(
    stop: float, drive: float
) -> None:
    scene = load_scene("gap", [f"drive.x={drive}", f"element.stop.stiffness={stop}"])
    problem = problem_of(scene)
    rest, struck = static_equilibrium(problem), Struck(stop, drive)
    options = CurveOptions(2.0 * np.pi * 4.5, 2.0 * np.pi * 8.0)

    told, true = [], []
    for each in frequency_response(problem, rest, options):
        beyond = np.hypot(*each.coefficients[1:3, 0]) > 1.02 * GAP  # no grazing
        if each.unstable > 0 and beyond and not each.event:
            _, omega, share, _ = struck.at(each)
            exactly = struck.multiplier(omega, share * 2.0 * np.pi / omega)
            true.append(abs(np.abs(each.multipliers).max() - exactly))
            told.append(multiplier_error(problem, rest, each, options))

    assert len(true) >= 8
    assert all(error <= bound for error, bound in zip(true, told, strict=True))
    assert max(told) < 0.02  # of multipliers up to 4


def test_the_error_of_a_multiplier_in_doubt_is_not_known(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = problem_of(load_scene("gap", ["drive.x=0.05"]))
    rest = static_equilibrium(problem)
    options = CurveOptions(2.0 * np.pi * 5.0, 2.0 * np.pi * 5.5)
    curve = list(frequency_response(problem, rest, options))
    unstable = next(each for each in curve if each.unstable > 0 and not each.event)

    def doubted(
        _: Multipliers, point: Array, fourier: FourierBasis, *__: object
    ) -> tuple[ComplexArray, FourierBasis, bool]:
        assert point.size
        return np.empty(0, complex), fourier, True

    known = multiplier_error(problem, rest, unstable, options)
    monkeypatch.setattr(Multipliers, "sure", doubted)
    doubt = multiplier_error(problem, rest, unstable, options)

    assert 0.0 < known < 1e-3
    assert doubt == math.inf

"""What multipliers that are known in closed form do between two points of a curve."""

import contextlib
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any, Self

import numpy as np
import pytest
from numpy.polynomial import polynomial

from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.segment import ROUGH
from hbm.continuation.step_control import StepControl
from hbm.events.amplitude_growth import AmplitudeGrowth
from hbm.events.events import Event, Events
from hbm.events.settled import Settled
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array, ComplexArray
from systems import Dense

FOURIER = FourierBasis(1, 16)
INSIDE, OUTSIDE, SADDLE, FLIPPED = (1.6, 0.63), (2.2, 1.3), (2.1, 1.08), (-1.9, 0.88)
"""sum and product of two multipliers: 0.9 and 0.7, 1.1 ± 0.3 i, 1.2 and 0.9, −1.1 and
−0.8"""


class Line:
    """The curve x = a + 2 p, with what an adaptive balance has besides a residual."""

    fourier = settled = FOURIER
    resolved = contextlib.nullcontext
    component = -1
    """that runs from 0 to 1"""
    aside = 0.0
    """error of the parameter at a fold"""
    estimate = None
    """of a point: none is asked for"""

    def __init__(self, start: float) -> None:
        self.start = start

    def __call__(self, point: Array) -> tuple[Array, Dense]:
        return np.array([point[0] - 2.0 * point[1] - self.start]), Dense([[1.0, -2.0]])

    def at(self, place: float) -> Array:
        """Return a point of the curve."""
        return np.array([self.start + 2.0 * place, place])

    def along(self, _: float) -> Array:
        """Return its tangent there."""
        return np.array([2.0, 1.0])

    def settle(self, correction: Correction, *_: object, **__: object) -> Correction:
        """Return a point that needs nothing more."""
        return correction

    @property
    def report(self) -> "Line":
        """What is reported of the last settled point."""
        return self

    def kept(self, point: Array) -> tuple[Array, object, float]:
        """Return a point as it is reported, its resolution and its error."""
        return point, FOURIER, 0.0

    def reported(self, correction: Correction, _: Array) -> tuple[Correction, object]:
        """Return a point as it is reported, and its resolution."""
        return correction, FOURIER


class Parabola(Line):
    """The curve p = 1 − (x − a)², which folds at a."""

    component = 0

    def __call__(self, point: Array) -> tuple[Array, Dense]:
        aside = point[0] - self.start
        return np.array([point[1] - 1.0 + aside**2]), Dense([[2.0 * aside, 1.0]])

    def at(self, place: float) -> Array:
        """Return a point of the curve."""
        return np.array([place, 1.0 - (place - self.start) ** 2])

    def along(self, place: float) -> Array:
        """Return its tangent there."""
        return np.array([1.0, -2.0 * (place - self.start)])


class Known:
    """Multipliers between the places 0 and 1, through given sums and products."""

    component = -1

    def __init__(self, *ways: tuple[float, float]) -> None:
        places = np.linspace(0.0, 1.0, len(ways))
        self.path = polynomial.polyfit(places, np.array(ways), len(ways) - 1)

    def at(self, point: Array, fourier: FourierBasis = FOURIER) -> ComplexArray:  # noqa: ARG002
        """Return the multipliers at a point, the largest first."""
        total, product = polynomial.polyval(point[self.component], self.path)
        found = np.roots([1.0, -total, product]).astype(complex)
        ordered: ComplexArray = found[np.argsort(-np.abs(found))]
        return ordered

    @property
    def orbits(self) -> Self:
        """What finds it with another resolution."""
        return self

    def finer(self, point: Array, _: FourierBasis) -> Array:
        """Return the point with another resolution: it is known without any."""
        return point


class Passing(Known):
    """Real multipliers that pass +1 at given places."""

    def __init__(self, *places: float, truncated: float = 0.0) -> None:
        self.places, self.truncated = places, truncated

    def at(self, point: Array, fourier: FourierBasis = FOURIER) -> ComplexArray:
        """Return the multipliers at a point, the largest first.

        By more harmonics than the curve has they come to 1 elsewhere.
        """
        away = point[self.component] - np.array(self.places)
        if fourier.harmonics > FOURIER.harmonics:
            away -= self.truncated
        falling: ComplexArray = np.sort(1.0 + 0.3 * away)[::-1].astype(complex)
        return falling


class Leaping(Known):
    """A real multiplier that rises by 0.4 in all, half way partly by a leap."""

    def __init__(self, leap: float) -> None:
        self.leap = leap

    def at(self, point: Array, fourier: FourierBasis = FOURIER) -> ComplexArray:  # noqa: ARG002
        """Return the multiplier at a point, and another one."""
        away = point[self.component] - 0.5
        value = 1.0 + (0.4 - self.leap) * away + 0.5 * self.leap * np.sign(away)
        return np.array([value, 0.1], dtype=complex)


def amplitudes(points: Sequence[Array]) -> Array:
    """Return the amplitudes; there are none beyond the limits of the parameter."""
    assert all(0.0 <= point[-1] <= 1.0 for point in points)
    return np.abs([point[:1] for point in points])


def found(known: Known, line: Line, **more: bool) -> list[tuple[str, float]]:
    """Return the events between the places 0 and 1, and where they are."""
    told = happening(known, line, **more)
    return [(each.name, each.correction.point[line.component]) for each in told]


def happening(
    known: Known, line: Line, *, owes: bool = False, recalls: bool = False
) -> list[Event]:
    """Return the events between the places 0 and 1.

    ``owes`` says that no multiplier has crossed for a fold before 0, ``recalls`` that
    there are sliders.
    """
    known.component = line.component
    system: Any = line
    resolution: Any = SimpleNamespace(amplitudes=amplitudes)
    multipliers: Any = known
    events = Events(
        system,
        AmplitudeGrowth(resolution, (0.0, 1.0)),
        StepControl(),
        multipliers,
        recalls=recalls,
    )
    ends = []
    for place in (0.0, 1.0):
        point, along = line.at(place), line.along(place)
        residual, linearised = line(point)
        solved = Correction(
            point,
            residual,
            linearised,
            Outcome.CONVERGED,
            (0.0,),
            along / np.linalg.norm(along),
        )
        settled = Settled(
            solved, FOURIER, known.at(point), FOURIER, False, solved, FOURIER, owes=owes
        )
        ends.append(events.directed(settled, np.ones_like))
    return list(events.between(ends[0], ends[1], np.ones_like))


def test_rounding_is_no_growth_of_an_amplitude() -> None:
    sizes = np.array([[1.0], [1.0 + 4e-16]])
    resolution: Any = SimpleNamespace(amplitudes=lambda _: sizes)
    none: Any = None
    growth = AmplitudeGrowth(resolution, (0.0, 1.0))
    point = np.array([1.0, 0.5])
    solved = Correction(point, point, none, Outcome.CONVERGED, (0.0,), point)

    assert growth(solved) == 0.0
    sizes[1] += 1e-10
    assert growth(solved) > 0.0


def test_the_first_of_equal_amplitudes_stands_for_all() -> None:
    sizes = np.array([[1.0, 1.0 + 1e-15], [1.1, 0.9]])
    resolution: Any = SimpleNamespace(amplitudes=lambda _: sizes)
    none: Any = None
    growth = AmplitudeGrowth(resolution, (0.0, 1.0))
    point = np.array([1.0, 0.5])
    solved = Correction(point, point, none, Outcome.CONVERGED, (0.0,), point)

    assert growth(solved) > 0.0


def crossing(known: Known, circle: Array) -> list[float]:
    """Return where a combination (1, sum, product) vanishes between 0 and 1."""
    combined = circle[1] * known.path[:, 0] + circle[2] * known.path[:, 1]
    combined[0] += circle[0]
    roots = polynomial.polyroots(combined)
    real = roots[np.abs(roots.imag) < 1e-12].real
    return sorted(real[(real > 0.0) & (real < 1.0)])


AT_ONE, AT_MINUS_ONE, ON_CIRCLE = np.array(
    [[1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 0.0, 1.0]]
)


@pytest.mark.parametrize(
    ("ways", "name", "circle"),
    [
        ((INSIDE, OUTSIDE), "Neimark-Sacker", ON_CIRCLE),
        ((OUTSIDE, INSIDE), "Neimark-Sacker", ON_CIRCLE),
        ((INSIDE, SADDLE), "branch point", AT_ONE),
        # a pair that has met on the real axis: one after the other
        ((OUTSIDE, SADDLE, INSIDE), "branch point", AT_ONE),
        ((INSIDE, SADDLE, OUTSIDE), "branch point", AT_ONE),
        # only one of them comes back
        ((OUTSIDE, SADDLE), "branch point", AT_ONE),
        ((INSIDE, FLIPPED), "period doubling", AT_MINUS_ONE),
    ],
)
def test_a_crossing_is_named_by_what_the_multiplier_is_there(
    ways: tuple[tuple[float, float], ...], name: str, circle: Array
) -> None:
    known = Known(*ways)
    places = crossing(known, circle)
    assert places

    events = found(known, Line(2.0))

    assert [each for each, _ in events] == [name] * len(places)
    # located to a thousandth of the step
    np.testing.assert_allclose([place for _, place in events], places, atol=2e-3)


@pytest.mark.parametrize("start", [2.0, 0.0], ids=["moving", "from rest"])
def test_nothing_happens_where_multipliers_stay_inside(start: float) -> None:
    assert found(Known(INSIDE, (1.5, 0.6)), Line(start)) == []


@pytest.mark.parametrize(
    ("leap", "recalls", "told"),
    [
        (0.4, True, False),
        (0.2, True, False),
        (0.02, True, True),  # half of it is left: a fortieth of the change
        (0.0, True, True),
        (0.4, False, True),  # nothing begins to slip
    ],
)
def test_a_multiplier_that_leaps_as_a_slider_begins_to_slip_crosses_nothing(
    leap: float, recalls: bool, told: bool
) -> None:
    events = found(Leaping(leap), Line(2.0), recalls=recalls)

    assert [name for name, _ in events] == ["branch point"] * told
    assert [place for _, place in events] == pytest.approx([0.5] * told, abs=2e-3)


@pytest.mark.parametrize(
    ("owes", "places", "told"),
    [
        (False, (0.3,), [0.3]),
        (True, (0.3,), []),
        (False, (0.3, 0.8), [0.3, 0.8]),
        (True, (0.3, 0.8), [0.8]),
        (True, (), []),
    ],
)
def test_a_crossing_that_a_fold_behind_owes_is_no_branch_point(
    owes: bool, places: tuple[float, ...], told: list[float]
) -> None:
    events = found(Passing(*places, 5.0), Line(2.0), owes=owes)

    assert [name for name, _ in events] == ["branch point"] * len(told)
    assert [place for _, place in events] == pytest.approx(told, abs=2e-3)


@pytest.mark.parametrize(
    ("fold", "places", "names"),
    [
        (0.3, (0.31,), ["fold"]),
        (0.3, (0.3, 0.9), ["fold", "branch point"]),
        (0.3, (0.25, 0.3), ["branch point", "fold"]),
        (0.3, (0.9,), ["fold", "branch point"]),
        # the fold is just beyond the end
        (1.001, (0.9995,), []),
        (1.001, (0.9,), ["branch point"]),
    ],
)
def test_a_branch_point_is_told_unless_it_is_the_folds(
    fold: float, places: tuple[float, ...], names: list[str]
) -> None:
    events = found(Passing(*places), Parabola(fold))

    assert [name for name, _ in events] == names
    for name, place in events:
        known = (fold,) if name == "fold" else places
        assert np.abs(place - np.array(known)).min() < 2e-3


def test_a_crossing_errs_by_what_more_harmonics_change() -> None:
    (event,) = happening(Passing(0.5, truncated=0.01), Line(0.0))

    assert abs(event.correction.point[-1] - 0.5) < 1e-4
    # twice the change, and the precision of the place
    assert event.error == pytest.approx(2 * 0.01 + ROUGH, rel=1e-3)

"""Which tangents of a contact point can differ from zero."""

import itertools
from collections.abc import Sequence

import numpy as np
import pytest

from contact_tables import (
    FRICTION_LAWS,
    REGIONS,
    Region,
    contact_points,
    every_combination,
    separated,
    slipping,
    sticking,
    written,
)
from microslip_mechanics.contact.law import tangent_pattern
from microslip_mechanics.contact.points import (
    BRISTLE,
    ELASTIC,
    FRICTIONLESS,
    ONE_SIDED,
    TWO_SIDED,
    ContactPoints,
)

pytestmark = pytest.mark.kernels


def check_patterns(points: ContactPoints, regions: Sequence[Region], seed: int) -> None:
    """Check that patterns hold what is ever written in the regions, and no more."""
    random, count = np.random.default_rng(seed), len(points.load)
    patterns = [tangent_pattern(points, point) for point in range(count)]

    seen = np.zeros((2, count, 3, 3), dtype=bool)
    for region in 8 * list(regions):
        _, *tangents = written(points, region(points, random))
        seen |= np.array(tangents) != 0.0
    np.testing.assert_array_equal(seen, np.swapaxes(np.array(patterns), 0, 1))


@pytest.mark.parametrize("friction", FRICTION_LAWS.values(), ids=FRICTION_LAWS)
def test_pattern_holds_each_tangent_that_is_ever_written_and_no_other(
    friction: int,
) -> None:
    check_patterns(every_combination(friction), REGIONS, 11)


@pytest.mark.parametrize("friction", [FRICTIONLESS, ELASTIC, BRISTLE])
def test_pattern_leaves_out_springs_dampers_and_drag_that_are_none(
    friction: int,
) -> None:
    rows = list(
        itertools.product((ONE_SIDED, TWO_SIDED), (0.0, 3.0), (0.0, 0.8), (0.0, 0.04))
    )
    normal, stiffness, damping, viscous = zip(*rows, strict=True)
    points = contact_points(
        len(rows),
        friction=friction,
        normal=normal,
        stiffness=stiffness,
        damping=damping,
        viscous=viscous,
        constant_load=True,
    )

    check_patterns(points, [sticking, slipping, separated], 12)

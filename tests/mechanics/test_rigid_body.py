"""Rigid bodies against clouds of point masses."""

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.rigid_body import point_motion, rigid_mass


def cloud(seed: int) -> tuple[Array, Array]:
    """Return masses [kg] and positions from the node [m] of a dozen points."""
    random = np.random.default_rng(seed)
    return random.uniform(0.1, 2.0, 12), random.normal([0.3, -0.7, 0.2], 0.5, (12, 3))


def body(masses: Array, places: Array) -> tuple[float, Array, Array]:
    """Return mass, inertia about the centre of mass, and the centre of a cloud."""
    centre = masses @ places / masses.sum()
    arms = places - centre
    inertia = sum(
        mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        for mass, arm in zip(masses, arms, strict=True)
    )
    return float(masses.sum()), np.asarray(inertia), centre


def test_a_point_moves_by_displacement_plus_rotation_cross_offset() -> None:
    random = np.random.default_rng(1)
    offset, displacement, rotation = random.normal(size=(3, 3))

    moved = point_motion(offset) @ np.concatenate([displacement, rotation])

    expected = displacement + np.cross(rotation, offset)
    np.testing.assert_allclose(moved, expected, rtol=1e-14)


@pytest.mark.parametrize("seed", range(5))
def test_kinetic_energy_is_that_of_a_cloud_of_point_masses(seed: int) -> None:
    masses, places = cloud(seed)
    velocity, spin = np.random.default_rng(seed + 100).normal(size=(2, 3))
    motion = np.concatenate([velocity, spin])

    matrix = rigid_mass(*body(masses, places))

    speeds = velocity + np.cross(spin, places)
    energy = 0.5 * masses @ np.sum(speeds**2, axis=1)
    assert 0.5 * motion @ matrix @ motion == pytest.approx(energy, rel=1e-13, abs=0.0)


def test_mass_is_the_same_in_every_direction_and_does_not_depend_on_the_offset() -> (
    None
):
    mass, inertia, centre = body(*cloud(7))

    matrix = rigid_mass(mass, inertia, centre)

    np.testing.assert_allclose(matrix[:3, :3], mass * np.eye(3), rtol=1e-14)


def test_inertia_about_the_node_follows_the_parallel_axis_theorem() -> None:
    mass, inertia, centre = body(*cloud(8))

    matrix = rigid_mass(mass, inertia, centre)

    steiner = mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    np.testing.assert_allclose(matrix[3:, 3:], inertia + steiner, rtol=1e-14)


def test_translation_and_rotation_are_coupled_by_the_offset_alone() -> None:
    mass, inertia, centre = body(*cloud(9))
    spin = np.array([0.4, -1.1, 0.8])

    coupled = rigid_mass(mass, inertia, centre)
    centred = rigid_mass(mass, inertia, np.zeros(3))

    momentum = coupled[:3, 3:] @ spin
    np.testing.assert_allclose(momentum, mass * np.cross(spin, centre), rtol=1e-14)
    np.testing.assert_array_equal(centred[:3, 3:], 0.0)
    np.testing.assert_array_equal(centred[3:, 3:], inertia)


def test_mass_matrix_is_symmetric_and_positive_definite() -> None:
    matrix = rigid_mass(*body(*cloud(10)))

    smallest = np.linalg.eigvalsh(matrix)[0]

    np.testing.assert_allclose(matrix, matrix.T, rtol=0.0, atol=1e-14)
    assert smallest > 0.0

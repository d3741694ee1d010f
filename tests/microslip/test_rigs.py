"""From scenes to problems: size, loads, contacts and probes of the three models."""

import numpy as np
import pytest

import rigs
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.contact.points import COULOMB, FRICTIONLESS, GENERAL_KINETIC
from microslip_mechanics.static import static_equilibrium

PROBES = (
    "excited-blade",
    "follower-blade",
    "friction-element",
    "element-to-excited",
    "element-to-follower",
)


@pytest.mark.parametrize(
    ("model", "dofs", "contacts"),
    [
        ("full", 54, ("B1", "B2", "B3", "B4", "A1", "A2", "A3", "A4")),
        ("B", 51, ("B1", "A1")),
        ("A", 51, ("B1", "A1")),
    ],
)
def test_models_have_the_size_that_the_paper_gives(
    model: str, dofs: int, contacts: tuple[str, ...]
) -> None:
    problem = problem_of(load_scene("two-blades", [f"model={model}"]))

    assert problem.structure.dofs == dofs
    assert problem.interface.names == contacts
    assert problem.probes.names == PROBES


@pytest.mark.parametrize("model", ["full", "B", "A"])
def test_scene_makes_the_problem_of_its_rig(model: str) -> None:
    problem = problem_of(load_scene("two-blades", [f"model={model}"]))

    expected = rigs.rig_problem(model=model)
    np.testing.assert_array_equal(
        problem.structure.stiffness, expected.structure.stiffness
    )
    np.testing.assert_array_equal(problem.structure.mass, expected.structure.mass)
    np.testing.assert_array_equal(problem.drive, expected.drive)
    for mine, other in zip(
        problem.interface.points, expected.interface.points, strict=True
    ):
        np.testing.assert_array_equal(mine, other)


@pytest.mark.parametrize("model", ["full", "B", "A"])
def test_loads_work_on_the_motion_of_the_bodies_they_act_on(model: str) -> None:
    overrides = [f"model={model}", "preload.force=3", "excitation.force=2"]

    problem = problem_of(load_scene("two-blades", overrides))

    # the drive works on the excited blade end along z, the preload on no z at all
    excited, _, element = problem.probes.rows[:3]
    np.testing.assert_allclose(problem.drive, 2.0 * excited, atol=1e-12)
    assert problem.preload @ element == 0.0
    assert np.abs(problem.preload).max() == 3.0


@pytest.mark.parametrize("model", ["full", "B", "A"])
def test_relative_probes_are_differences_of_absolute_ones(model: str) -> None:
    rows = problem_of(load_scene("two-blades", [f"model={model}"])).probes.rows

    np.testing.assert_allclose(rows[3], rows[2] - rows[0], atol=1e-15)
    np.testing.assert_allclose(rows[4], rows[2] - rows[1], atol=1e-15)


@pytest.mark.parametrize(
    ("law", "kind"),
    [("none", FRICTIONLESS), ("coulomb", COULOMB), ("gkf", GENERAL_KINETIC)],
)
def test_law_of_the_scene_holds_at_every_point(law: str, kind: int) -> None:
    problem = problem_of(load_scene("two-blades", [f"friction.law={law}"]))

    assert problem.interface.points.friction.tolist() == [kind] * 8


def test_model_a_alone_has_constant_normal_loads_those_of_the_paper() -> None:
    points = {
        model: problem_of(load_scene("two-blades", [f"model={model}"])).interface.points
        for model in ("full", "B", "A")
    }

    assert points["A"].constant_load.all()
    assert not points["B"].constant_load.any()
    assert not points["full"].constant_load.any()
    np.testing.assert_allclose(points["A"].load, [2.924, 2.747], rtol=2e-4)


def test_stiffness_and_damping_of_the_contacts_are_those_of_the_paper() -> None:
    points = problem_of(load_scene("two-blades")).interface.points

    face_b, face_a = 0, 4
    assert points.stiffness[face_a] == pytest.approx(3.3333e12, rel=2e-5)
    assert points.stiffness[face_b] == pytest.approx(3.5473e12, rel=2e-5)
    assert points.damping[face_a] == pytest.approx(4.73e4, rel=1e-3)
    assert points.damping[face_b] == pytest.approx(4.88e4, rel=1e-3)


@pytest.mark.parametrize("override", ["", "rope.stiffness=0"])
def test_rope_is_a_spring_of_the_friction_element_along_z(override: str) -> None:
    scene = load_scene("two-blades", [override] if override else [])

    structure = problem_of(scene).structure

    place = structure.names.index("friction-element.uz")
    rope = 0.0 if override else 10.0
    assert structure.stiffness[place, place] == pytest.approx(rope, abs=1e-12)


@pytest.mark.parametrize(
    ("model", "elements"),
    [("full", 1), ("A", 1), ("full", 10), ("full", 20), ("A", 30)],
)
def test_number_of_elements_does_not_change_how_the_wedge_is_held(
    model: str, elements: int
) -> None:
    overrides = [f"model={model}", f"blade.elements={elements}"]

    rest = static_equilibrium(problem_of(load_scene("two-blades", overrides)))

    four = static_equilibrium(problem_of(load_scene("two-blades", overrides[:1])))
    np.testing.assert_allclose(rest.normal_force, four.normal_force, atol=1e-5)

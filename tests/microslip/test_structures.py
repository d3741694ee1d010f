"""Damping, reduction, rotation, moving ground and engine orders of scenes."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse

import microslip
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import built_in_text, load_scene
from microslip.scenes.systems.build import reduction
from microslip.studies.explain.explain import pruned
from microslip.studies.parameter import parameter
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction.reduced_problem import (
    Method,
    ReducedProblem,
    reduced_problem,
)
from microslip_mechanics.static import static_equilibrium
from scene_texts import EXPERIMENTS, NODES, made

BEAM = """
scene = "system"
[structure.beam]
length = "120 mm"
elements = 3
width = "30 mm"
thickness = "6 mm"
young_modulus = "210 GPa"
poisson_ratio = 0.3
density = 7800
[probes]
tip = "tip.uz"
"""
PULL = '[drive]\n"tip.uz" = 1\n'
REDUCED = f"""
{BEAM.replace("elements = 3", "elements = 20")}
[structure.reduction]
highest = "20 kHz"
keep = ["node7"]
[[element]]
name = "stop"
law = "cubic-spring"
between = ["node5.uz", "ground"]
cubic = 1e9
{PULL}
"""


def ratios(problem: Problem) -> np.ndarray:
    """Return the damping ratio of each mode, the slowest first."""
    structure = problem.structure
    squares, shapes = scipy.linalg.eigh(structure.stiffness, structure.mass)
    rates = np.diag(shapes.T @ structure.damping @ shapes)
    return rates / (2.0 * np.sqrt(squares))


def test_a_loss_factor_is_half_of_it_in_each_mode(tmp_path: Path) -> None:
    text = "[structure]\nloss_factor = 0.02\n[structure.beam]"
    beam = BEAM.replace("[structure.beam]", text)

    assert ratios(made(tmp_path, beam + PULL)) == pytest.approx(0.01, rel=1e-8)


def test_listed_ratios_are_those_of_the_slowest_modes(tmp_path: Path) -> None:
    text = "[structure]\ndamping_ratios = [0.01, 0.03]\n[structure.beam]"

    found = ratios(made(tmp_path, BEAM.replace("[structure.beam]", text) + PULL))

    assert found[:2] == pytest.approx([0.01, 0.03], rel=1e-8)
    assert (np.diff(found[1:]) > 0.0).all()


RAYLEIGH = """
[structure.rayleigh]
frequencies = ["100 Hz", "2 kHz"]
ratios = [0.02, 0.01]
"""


def test_two_ratios_make_rayleighs_damping(tmp_path: Path) -> None:
    structure = made(tmp_path, BEAM + RAYLEIGH + PULL).structure

    rows = np.stack([structure.mass.ravel(), structure.stiffness.ravel()], axis=1)
    scale = np.abs(rows).max(axis=0)
    alpha, beta = np.linalg.lstsq(rows / scale, structure.damping.ravel())[0] / scale
    for hertz, ratio in ((100.0, 0.02), (2000.0, 0.01)):
        speed = 2.0 * np.pi * hertz
        assert alpha + beta * speed**2 == pytest.approx(2.0 * ratio * speed, rel=1e-9)


def test_moving_ground_loads_each_mass_along_its_direction(tmp_path: Path) -> None:
    text = NODES + '[base]\ndirection = [0, 0, 2]\nacceleration = "500 mm/s^2"\n'

    problem = made(tmp_path, text)

    assert problem.drive == pytest.approx(-0.5 * np.array([0, 1, 0, 2, 0, 3]))


@pytest.mark.parametrize("beam", [False, True])
def test_ground_along_which_nothing_moves_is_refused(
    beam: bool, tmp_path: Path
) -> None:
    plane = BEAM.replace("elements = 3", "elements = 3\nplane = true")
    text = plane if beam else NODES
    base = "[base]\ndirection = [0, 1, 0]\nacceleration = 1\n"

    with pytest.raises(SceneError, match=r"base: nothing .* moves along \[0, 1, 0\]"):
        made(tmp_path, text + base)


def test_moving_ground_loads_a_beam_by_all_of_its_mass(tmp_path: Path) -> None:
    problem = made(tmp_path, BEAM + "[base]\ndirection = [0, 0, 1]\nacceleration = 2\n")

    names = problem.structure.names
    lift = np.array([float(name.endswith("uz")) for name in names])
    # the first half of the first element hangs on the foot, by its consistent mass
    carried = 0.12 * 0.03 * 0.006 * 7800.0 * (1.0 - 0.5 / 3.0)
    assert -problem.drive @ lift / 2.0 == pytest.approx(carried, rel=1e-9)


ORDER = """
[engine_order]
blades = ["1.z", "2.z", "3.z"]
order = 1
amplitude = "2 N"
"""


def test_engine_order_turns_from_blade_to_blade(tmp_path: Path) -> None:
    text = NODES + ORDER

    problem = made(tmp_path, text)

    turn = np.exp(2j * np.pi * np.arange(3) / 3.0)
    assert problem.drive[1::2] == pytest.approx(2.0 * turn)
    assert not problem.drive[::2].any()


TURN = """
[structure.rotation]
speed = "6000 rpm"
axis = [0, 1, 0]
centre = ["-0.1 m", 0, 0]
"""


def test_a_turning_beam_is_stretched_stiffened_and_gyroscopic(tmp_path: Path) -> None:
    still, turning = made(tmp_path, BEAM + PULL), made(tmp_path, BEAM + TURN + PULL)

    speed = 6000.0 * np.pi / 30.0
    pull = turning.preload[[name.endswith("ux") for name in turning.structure.names]]
    # of all elements but for what the foot carries: ∫ ρ A Ω² (0.1 + x) N dx
    line = 7800.0 * 0.03 * 0.006 * speed**2
    part = 0.04
    foot = line * part * (0.1 / 2.0 + part / 6.0)
    whole = line * 0.12 * (0.1 + 0.06)
    assert pull.sum() == pytest.approx(whole - foot, rel=1e-9)
    assert turning.structure.gyroscopic
    lowest = [
        scipy.linalg.eigh(each.structure.stiffness, each.structure.mass)[0][0]
        for each in (still, turning)
    ]
    assert lowest[1] > lowest[0]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('speed = "6000 rpm"\n', "", "[structure.rotation] speed is missing: add it"),
        ("6000 rpm", "fast", '[structure.rotation] speed = "fast": is not a number'),
        ("[0, 1, 0]", "[0, 1]", "axis of rotation has 2 numbers: give three"),
        ("[0, 1, 0]", "[0, 0, 0]", "axis of rotation is zero: give a direction"),
    ],
)
def test_a_table_in_a_table_has_both_names(
    old: str, new: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(SceneError, match=re.escape(said)):
        made(tmp_path, BEAM + TURN.replace(old, new) + PULL)


def test_a_rig_that_turns_presses_its_element_by_its_own_weight() -> None:
    loose = ["preload.force=0"]
    turn = ["speed=50 Hz", "axis=[0, 0, 1]", "centre=[-0.5, 0, 0]"]
    still = problem_of(load_scene("two-blades", loose))
    turning = problem_of(
        load_scene("two-blades", loose + [f"rotation.{each}" for each in turn])
    )

    assert not still.preload.any()
    assert turning.structure.gyroscopic
    gaps = turning.interface.displacement @ static_equilibrium(turning).displacement
    assert gaps[::3].max() > 0.0


@pytest.mark.parametrize(
    "turn",
    [
        ["axis=[0, 0, 1]", "centre=[-0.5, 0, 0]"],
        ["axis=[0, 1, 0]", "centre=[-0.5, 0, 0]"],
        ["axis=[0, 0, 1]", "centre=[-0.5, 0.1, 0]"],
    ],
)
def test_constant_load_of_a_rig_that_turns_is_that_of_its_static_equilibrium(
    turn: list[str],
) -> None:
    loose = ["model=A", "preload.force=3", "contact.angle_excited=20 deg"]
    turning = [f"rotation.{each}" for each in ("speed=20 Hz", *turn)]

    problem = problem_of(load_scene("two-blades", [*loose, *turning]))

    still = problem_of(load_scene("two-blades", loose))
    load = problem.interface.points.load
    assert np.all(load > 1.5 * still.interface.points.load)
    # the element yields 2 mm outwards, where its load is larger
    assert static_equilibrium(problem).normal_force == pytest.approx(load, rel=6e-3)


def test_model_a_refuses_a_rotation_that_lifts_a_face() -> None:
    turn = ["speed=50 Hz", "axis=[0, 0, 1]", "centre=[0.5, 0, 0]"]
    scene = load_scene("two-blades", ["model=A", *(f"rotation.{e}" for e in turn)])

    with pytest.raises(
        SceneError, match=r"^\[rotation\] lifts face B .*model B or full$"
    ):
        problem_of(scene)


LATTICE = 400


def lattice() -> Problem:
    """Return a sparse chain with a slider at its end."""
    ties = np.eye(LATTICE, k=1) + np.eye(LATTICE, k=-1)
    springs = 1e6 * (2.0 * np.eye(LATTICE) - ties)
    slider = microslip.Jenkins(stiffness=1e5, limit=1.0)
    return microslip.system(
        mass=scipy.sparse.eye(LATTICE, format="csc"),
        stiffness=scipy.sparse.csc_array(springs),
        damping_ratio=[0.01, 0.01, 0.01],
        elements=[microslip.Element(slider, between=(f"x{LATTICE}", "ground"))],
        drive={"x200": 10.0},
        probes=[f"x{LATTICE}", "x200"],
    )


@pytest.mark.parametrize(
    "method", ["craig-bampton", pytest.param("modal", marks=pytest.mark.long)]
)
def test_reduction_keeps_the_curve_and_states_its_error(method: Method) -> None:
    whole = lattice()

    reduced = microslip.reduced_problem(whole, 60.0, method=method)

    assert reduced.problem.structure.dofs < 60
    assert reduced.error(2.0) < 1e-5
    curves = [
        microslip.curve(each, 1.1, 1.5, harmonics=3)
        for each in (whole, reduced.problem)
    ]
    largest = [each.amplitude.max(axis=0) for each in curves]
    assert largest[1] == pytest.approx(largest[0], rel=5e-6)


def test_a_scene_is_reduced_to_contacts_loads_and_what_it_keeps(tmp_path: Path) -> None:
    problem = made(tmp_path, REDUCED)

    names = problem.structure.names
    assert {"tip.uz", "node5.uz", "node7.ry"} <= set(names)
    assert 8 < problem.structure.dofs < 20
    scene = load_scene(str(tmp_path / "mine.toml"))
    made_of = reduction(scene.rig)
    assert made_of is not None
    assert made_of.error(500.0) < 2e-4  # measured 1.3e-4
    told = pruned(scene)[0]
    assert (told.kept, told.whole) == (problem.structure.dofs, 120)
    assert f"otherwise by {made_of.error(7.0):.1e} at 7 Hz" in told.reason
    static = np.linalg.solve(problem.structure.stiffness, problem.drive)
    exact = 0.12**3 / (3.0 * 210e9 * 0.03 * 0.006**3 / 12.0)
    assert (problem.probes.rows @ static)[0] == pytest.approx(exact, rel=1e-6)


def test_what_is_kept_is_told_of_one_reduction(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(REDUCED + EXPERIMENTS, encoding="utf-8")
    calls = []

    def counted(*given: Any, **more: Any) -> ReducedProblem:
        calls.append(given)
        return reduced_problem(*given, **more)

    monkeypatch.setattr(
        "microslip_mechanics.reduction.reduced_problem.reduced_problem", counted
    )
    pruned(load_scene(str(path)))

    assert len(calls) == 1


@pytest.mark.parametrize(
    ("scene", "more", "cause"),
    [
        ("jenkins", "", "belongs to a beam"),
        ("friction-beam", "", "plane = true"),
        ("tip-damper", '[structure.masses]\npin = "50 g"\n', "places of point masses"),
    ],
)
def test_what_cannot_rotate_is_told(
    scene: str, more: str, cause: str, tmp_path: Path
) -> None:
    turn = '[structure.rotation]\nspeed = "50 Hz"\naxis = [0, 0, 1]\n' + more
    path = tmp_path / "turning.toml"
    path.write_text(built_in_text(scene).replace("[drive]", turn + "[drive]", 1))

    with pytest.raises(SceneError, match=rf"\[structure.rotation\] .*{cause}"):
        problem_of(load_scene(str(path)))


def test_an_element_without_a_name_is_set_by_its_number(tmp_path: Path) -> None:
    path = tmp_path / "unnamed.toml"
    path.write_text(built_in_text("jenkins").replace('name = "slider"\n', ""))

    scene = load_scene(str(path), ["element.element-1.limit=2"])

    assert problem_of(scene).interface.points.dynamic[0] != 0.0
    assert scene.rig.element["element-1"].limit == 2.0


def test_an_element_with_dots_in_its_name_is_set_and_followed(tmp_path: Path) -> None:
    path = tmp_path / "dotted.toml"
    path.write_text(built_in_text("jenkins").replace('"slider"', '"tip.left"'))

    scene = load_scene(str(path), ["element.tip.left.limit=2"])
    followed = parameter(str(path), (), "element.tip.left.limit", "2", "3")

    assert scene.rig.element["tip.left"].limit == 2.0
    assert followed.label == "element.tip.left.limit [N]"


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("element.slider=2", "give element.NAME.KEY=value"),
        ("element.slide.limit=2", "there is no element slide: do you mean slider?"),
    ],
)
def test_an_override_that_reaches_no_key_of_an_element_is_refused(
    override: str, message: str
) -> None:
    with pytest.raises(SceneError, match=f"^--set {override}: {re.escape(message)}$"):
        load_scene("jenkins", [override])


def test_a_power_that_is_no_number_is_told(tmp_path: Path) -> None:
    path = tmp_path / "spring.toml"
    spring = 'law = "polynomial-spring"\ncoefficients = {a = 1}'
    text = built_in_text("duffing").replace('law = "cubic-spring"', spring)
    path.write_text(text.replace('cubic = "0.05 N/mm^3"\n', ""))

    with pytest.raises(SceneError, match=r"coefficients: power a is no number: give"):
        load_scene(str(path))

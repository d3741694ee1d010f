"""What a scene keeps and leaves out, counted."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest

from microslip.scenes.scene_file import built_in_text, load_scene
from microslip.studies.explain.explain import pruned
from microslip.studies.explain.imported import FRC, imported
from microslip.studies.explain.pruned import Pruned

Run: TypeAlias = Callable[..., tuple[int, str, str]]
COARSE = ("curve.harmonics=3", "curve.samples=64")


def counted(*overrides: str, source: str = "two-blades") -> dict[str, Pruned]:
    """Return what a scene keeps, by name."""
    found = pruned(load_scene(source, [*COARSE, *overrides]))
    return {each.what: each for each in found}


@pytest.mark.parametrize(
    ("model", "dofs", "points"),
    [
        pytest.param("full", 54, 8, marks=pytest.mark.long),
        pytest.param("B", 51, 2, marks=pytest.mark.long),
        ("A", 51, 2),
    ],
)
def test_models_keep_what_their_rotations_and_faces_need(
    model: str, dofs: int, points: int
) -> None:
    found = counted(f"model={model}")

    freedoms, contacts = found["degrees of freedom"], found["contact points"]
    assert (freedoms.kept, freedoms.whole) == (dofs, 54)
    assert model in freedoms.reason
    assert (contacts.kept, contacts.whole) == (points, 8)


@pytest.mark.parametrize(
    ("model", "law", "kept"),
    [
        ("full", "coulomb", 8),
        ("full", "none", 0),
        ("B", "gkf", 2),
        ("A", "coulomb", 0),
        ("A", "none", 0),
    ],
)
def test_normal_loads_vary_only_where_friction_sees_them(
    model: str, law: str, kept: int
) -> None:
    loads = counted(f"model={model}", f"friction.law={law}")[
        "variable normal loads of friction"
    ]

    assert loads.kept == kept
    assert loads.whole == (8 if model == "full" else 2)


@pytest.mark.parametrize(("law", "kept"), [("coulomb", 1), ("gkf", 1), ("none", 0)])
def test_only_the_law_of_the_scene_is_called(law: str, kept: int) -> None:
    laws = counted(f"friction.law={law}")["friction laws called"]

    assert (laws.kept, laws.whole) == (kept, 6)


@pytest.mark.parametrize(
    ("model", "law", "kept"),
    [
        # per point: 2 normal, 4 of friction by velocity, 4 by the normal motion
        ("full", "coulomb", 8 * 10),
        ("full", "none", 8 * 2),
        ("B", "gkf", 2 * 10),
        ("A", "gkf", 2 * 6),
    ],
)
def test_tangents_are_those_that_the_laws_can_have(
    model: str, law: str, kept: int
) -> None:
    tangents = counted(f"model={model}", f"friction.law={law}")["tangents at a moment"]

    assert tangents.kept == kept
    assert tangents.whole == 18 * 8


@pytest.mark.parametrize(("name", "told"), [("jenkins", False), ("gap", True)])
def test_tangents_of_contacts_that_remember_are_not_counted(
    name: str, *, told: bool
) -> None:
    found = counted(source=name)

    assert ("tangents at a moment" in found) == told
    assert "calls of the contact law" in found


@pytest.mark.parametrize("stiffness", [0, 10])
def test_rope_without_stiffness_is_no_spring(stiffness: int) -> None:
    spring = counted(f"rope.stiffness={stiffness}")["springs to ground"]

    assert (spring.kept, spring.whole) == (int(stiffness > 0), 1)
    assert ("no rope" in spring.reason) == (stiffness == 0)


def test_scene_without_a_rope_has_no_spring(tmp_path: Path) -> None:
    text = built_in_text("two-blades")
    start, end = text.index("[rope]"), text.index("[contact]")
    path = tmp_path / "free.toml"
    path.write_text(text[:start] + text[end:], encoding="utf-8")

    spring = counted(source=str(path))["springs to ground"]

    assert (spring.kept, spring.whole) == (0, 1)


@pytest.mark.parametrize("model", ["full", "B", "A"])
def test_solvers_carry_the_six_relative_motions_at_the_most(model: str) -> None:
    found = counted(f"model={model}")

    step, balance = (
        found["unknowns of a time step"],
        found["coordinates of harmonic balance"],
    )
    assert balance.kept <= step.kept <= 12
    assert step.whole == found["degrees of freedom"].kept
    assert balance.whole == 12


def test_symmetry_leaves_out_about_half_of_the_unknowns() -> None:
    name = "unknowns of harmonic balance with 3 harmonics"
    unknowns = counted("model=full")[name]

    coordinates = counted("model=full")["coordinates of harmonic balance"]
    assert unknowns.whole == 7 * coordinates.whole
    assert 0.4 < unknowns.kept / unknowns.whole < 0.7


def test_unknowns_of_coordinates_that_move_are_not_said_to_be_symmetry() -> None:
    found = {each.what: each for each in pruned(load_scene("tip-damper"))}

    unknowns = found["unknowns of harmonic balance with 63 harmonics"]
    assert (unknowns.kept, unknowns.whole) == (2 * 127, 3 * 127)
    assert unknowns.reason == "of the coordinates above"


def test_unknowns_are_those_of_63_harmonics_where_the_tolerance_says_how_many() -> None:
    found = {each.what: each for each in pruned(load_scene("two-blades"))}

    unknowns = found["unknowns of harmonic balance with 63 harmonics"]
    assert unknowns.whole == 127 * found["coordinates of harmonic balance"].whole
    assert 0.4 < unknowns.kept / unknowns.whole < 0.6


def test_nothing_keeps_more_than_there_is() -> None:
    for model in ("full", "B", "A"):
        for each in counted(f"model={model}").values():
            assert 0 <= each.kept <= each.whole, each
            assert each.reason


def test_command_prints_a_line_for_each_with_its_reason(run: Run) -> None:
    sets = [f"--set={each}" for each in (*COARSE, "model=A")]

    status, output, error = run("explain", "two-blades", *sets)

    assert (status, error) == (0, "")
    for each in counted("model=A").values():
        (line,) = (line for line in output.splitlines() if line.startswith(each.what))
        numbers = line.removeprefix(each.what).split(maxsplit=2)
        assert numbers == [str(each.kept), str(each.whole), each.reason]
    assert "imports, by command" in output


def test_one_sector_of_a_disk_stands_for_all() -> None:
    found = counted(source="bladed-disk")

    assert (found["sectors"].kept, found["sectors"].whole) == (1, 24)
    assert (found["contact points"].kept, found["contact points"].whole) == (1, 24)
    assert found["degrees of freedom"].whole == 24 * found["degrees of freedom"].kept


def test_odd_motion_needs_half_the_orders_and_half_the_period() -> None:
    found = counted("model=A")

    moments, calls = (
        found["moments evaluated of 64 samples"],
        found["calls of the contact law"],
    )
    assert (moments.kept, moments.whole) == (32, 64)
    assert (calls.kept, calls.whole) == (2 * 32, 8 * 64)
    orders = found["orders of 3 harmonics and the mean"]
    assert (orders.kept, orders.whole) == (2, 4)


def test_frc_loads_less_than_there_is() -> None:
    found = counted("model=A")

    for name in ("modules loaded", "kernels loaded"):
        assert 0 < found[name].kept < found[name].whole
    every = imported(())
    assert every.modules > imported(FRC).modules > imported(("microslip",)).modules


def test_command_times_the_curve_with_and_without_pruning(
    run: Run, quick_scene: Path
) -> None:
    status, output, error = run("explain", str(quick_scene), "--time")

    assert (status, error) == (0, "")
    (line,) = (row for row in output.splitlines() if row.startswith("processor time"))
    some, every = (float(word) for word in line.split()[-2:])
    assert 0.0 < some < every
    assert "agree: amplitudes" in output


def test_command_says_so_if_pruning_changes_the_curve(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "microslip.studies.explain.unpruned.difference", lambda *_: 2e-6
    )

    status, output, _ = run("explain", str(quick_scene), "--time")

    assert status == 1
    assert "DISAGREE" in output


def test_interrupted_while_it_traces_it_names_no_file(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("microslip.studies.explain.unpruned.timed", interrupted)

    status, _, error = run("explain", str(quick_scene), "--time")

    assert (status, error) == (130, "microslip: interrupted; no file is written\n")


def test_the_rule_that_fixes_stuck_contacts_is_told(tmp_path: Path) -> None:
    path = tmp_path / "rigid.toml"
    path.write_text(
        """
scene = "system"
[structure]
mass = [1.0]
stiffness = [4.0]
[[element]]
name = "slider"
law = "rigid-coulomb"
load = 1.0
mu = 0.3
tangents = [["x1", "ground"]]
[drive]
x1 = 1.0
[curve]
lowest = 0.1
highest = 0.5
harmonics = 5
tolerance = 1e-3
[sweep]
ramp = 0
start = 0
end = 9
duration = 9
lowest = 0.1
highest = 0.5
[march]
time_step = 0.01
store_every = 10
""",
        encoding="utf-8",
    )
    counts = {each.what: each for each in pruned(load_scene(str(path)))}

    stuck = counts["mean friction of stuck contacts"]
    assert (stuck.kept, stuck.whole) == (0, 1)
    # displacement and push, odd harmonics only
    unknowns = counts["unknowns of harmonic balance with 5 harmonics"]
    assert (unknowns.kept, unknowns.whole) == (2 * 6, 2 * 11)

"""The paper's tables: its numbers, our rows beside them, and the command."""

import csv
import dataclasses
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies import tables
from microslip.studies.sweep import march_whole, swept_sine
from microslip.studies.tables import PAPER, SENSITIVITIES, Row, Variant, rows
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.integrate import IntegrationError
from timedomain.step_doubling import CAUTION

Run: TypeAlias = Callable[..., tuple[int, str, str]]

SHORT = (
    "model=A",
    "sweep.ramp=0.1",
    "sweep.start=0.2",
    "sweep.end=2.1",
    "sweep.duration=2.1",
    "sweep.lowest=130",
    "sweep.highest=140",
    "march.time_step=2e-4",
)
"""a sweep of the built-in scene that takes no time"""
COULOMB = Variant("coulomb, short", SHORT, 0.149)
OURS = Variant("gkf, short", (*SHORT, "friction.law=gkf"), math.nan)


@pytest.mark.parametrize(
    ("law", "full", "soft", "b", "a"),
    [
        # section 3 and Table 5, row 1; section 5 and Table 5, row 2
        ("coulomb", 0.009, 0.143, 0.148, 0.149),
        ("gkf", 0.014, 0.102, 0.099, 0.099),
    ],
)
def test_rows_hold_the_energies_that_the_paper_prints(
    law: str, full: float, soft: float, b: float, a: float
) -> None:
    printed = {variant.name: variant.paper for variant in PAPER}

    assert len(printed) == len(PAPER) == 8
    assert printed[f"{law}, full, stiff"] == full
    assert printed[f"{law}, full, soft"] == soft
    assert printed[f"{law}, B"] == b
    assert printed[f"{law}, A"] == a


@pytest.mark.parametrize("variant", PAPER, ids=lambda variant: variant.name)
def test_overrides_make_the_variant_that_a_row_names(variant: Variant) -> None:
    rig = load_scene("two-blades", variant.overrides).rig

    law, model, *contact = variant.name.split(", ")
    assert (rig.friction.law, rig.model) == (law, model)
    assert rig.contact.sigma == (3e-7 if contact == ["soft"] else 3e-9)
    own = load_scene("two-blades").rig
    assert dataclasses.replace(
        rig, model=own.model, friction=own.friction, contact=own.contact
    ) == dataclasses.replace(own)


def test_rows_of_our_own_have_no_number_of_the_paper() -> None:
    for variant in SENSITIVITIES:
        assert math.isnan(variant.paper)
        load_scene("two-blades", variant.overrides)


def test_row_holds_the_energy_that_friction_took() -> None:
    (row,) = rows("two-blades", (COULOMB,), halve=False)

    scene = load_scene("two-blades", SHORT)
    history = march_whole(problem_of(scene), swept_sine(scene.sweep), scene.march)
    assert row.variant is COULOMB
    assert row.energy == history.of("friction")[-1] > 0.0
    assert math.isnan(row.half_step_change)
    closing = np.abs(history.closing_error).max() / history.of("input").max()
    assert row.closing_error == pytest.approx(closing)
    assert 0.0 < row.seconds < 10.0
    np.testing.assert_allclose(row.rest, [2.924, 2.747], rtol=2e-4)


def test_halved_row_holds_the_finer_energy_and_what_it_changed() -> None:
    (row,) = rows("two-blades", (COULOMB,), halve=True)

    (coarse,) = rows("two-blades", (COULOMB,), halve=False)
    finer = Variant("finer", (*SHORT, "march.time_step=1e-4"), math.nan)
    (fine,) = rows("two-blades", (finer,), halve=False)
    assert row.energy == pytest.approx(fine.energy, rel=1e-12)
    assert row.half_step_change == pytest.approx(coarse.energy / fine.energy - 1.0)
    assert row.half_step_change != 0.0
    # the estimate of the finer march is of the same two, with caution
    assert abs(row.half_step_change) <= row.estimated
    assert row.estimated == pytest.approx(fine.estimated / CAUTION, rel=0.02)
    assert fine.estimated < coarse.estimated


def test_rows_come_one_by_one() -> None:
    wrong = Variant("wrong", ("model=C",), 0.0)

    found = rows("two-blades", (COULOMB, wrong), halve=False)

    assert next(found).variant is COULOMB


def test_rows_can_be_of_a_scene_file(tmp_path: Path) -> None:
    text = load_scene("two-blades").text.replace('force = "1 N"', "force = 0.5")
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")

    (mine,) = rows(str(path), (COULOMB,), halve=False)

    assert mine.rest.sum() == pytest.approx((2.924 + 2.747) / 2.0, rel=1e-3)


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave two rows of the tables."""
    monkeypatch.setattr("microslip.studies.tables.PAPER", (COULOMB,))
    monkeypatch.setattr("microslip.studies.tables.SENSITIVITIES", (OURS,))


@pytest.mark.usefixtures("few")
def test_command_prints_the_paper_beside_our_energy(run: Run) -> None:
    status, output, error = run("tables", "--quick")

    assert (status, error) == (0, "")
    (paper,) = (line for line in output.splitlines() if line.startswith(COULOMB.name))
    (ours,) = (line for line in output.splitlines() if line.startswith(OURS.name))
    energies = [row.energy for row in rows("two-blades", (COULOMB, OURS), halve=False)]
    printed = paper.removeprefix(COULOMB.name).split()
    assert printed[:3] == ["0.149", f"{energies[0]:.6f}", f"{energies[0] / 0.149:.3f}"]
    assert ours.removeprefix(OURS.name).split()[:4] == [
        "-",
        f"{energies[1]:.6f}",
        "-",
        "-",
    ]
    assert "jamming, coulomb, short" in output
    assert "see the row with V_lim" in output


@pytest.mark.usefixtures("few")
def test_command_writes_a_table_that_a_spreadsheet_reads(
    run: Run, tmp_path: Path
) -> None:
    status, _, _ = run("tables", "--csv", "tables.csv")

    with (tmp_path / "tables.csv").open(newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    assert status == 0
    assert [row["variant"] for row in table] == [COULOMB.name, OURS.name]
    (expected,) = rows("two-blades", (COULOMB,), halve=True)
    first, second = table
    assert float(first["paper [J]"]) == 0.149
    assert float(first["microslip [J]"]) == expected.energy
    assert float(first["ratio"]) == expected.energy / 0.149
    assert float(first["half-step change"]) == expected.half_step_change
    assert (second["paper [J]"], second["ratio"]) == ("", "")
    assert float(second["march [s]"]) > 0.0


@pytest.mark.usefixtures("few")
@pytest.mark.parametrize("done", [0, 1])
def test_interrupted_tables_keep_their_rows(
    done: int, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(
        source: str, variants: tuple[Variant, ...], *, halve: bool
    ) -> Iterator[Row]:
        yield from rows(source, variants[:done], halve=halve)
        assert written() == done  # already, so that a kill keeps them too
        raise KeyboardInterrupt

    def written() -> int:
        path = tmp_path / "tables.csv"
        return len(path.read_text().splitlines()) - 1 if path.exists() else 0

    monkeypatch.setattr("microslip.studies.tables.rows", interrupted)

    status, output, error = run("tables", "--quick", "--csv", "tables.csv")

    assert status == 130
    said = "what was computed is kept" if done else "no file is written"
    assert error == f"microslip: interrupted; {said}\n"
    assert (COULOMB.name in output) == (done == 1)
    assert OURS.name not in output
    assert "see the row" not in output
    assert written() == done


@pytest.mark.usefixtures("few")
def test_stuck_march_ends_the_tables_with_one_line_and_keeps_the_rows_before(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    stuck = Variant("stuck", (*SHORT, "friction.mu_dynamic=1e49"), math.nan)
    march = tables._march

    def marched(scene: Scene, share: float, *, estimate: bool) -> TimeHistory:
        if scene.rig.friction.mu_dynamic > 1e48:
            raise IntegrationError("the step at t = 0 s does not converge")
        return march(scene, share, estimate=estimate)

    monkeypatch.setattr("microslip.studies.tables.SENSITIVITIES", (stuck,))
    monkeypatch.setattr("microslip.studies.tables._march", marched)

    status, output, error = run("tables", "--quick")

    assert status == 1
    assert error.startswith("microslip: the step at t = ")
    assert len(error.splitlines()) == 1
    assert COULOMB.name in output


@pytest.mark.usefixtures("few")
def test_csv_without_a_place_is_told_in_one_line(run: Run) -> None:
    status, _, error = run("tables", "--quick", "--csv", "nowhere/tables.csv")

    assert status == 2
    assert error.startswith("microslip: ")
    assert "nowhere" in error
    assert len(error.splitlines()) == 1


@pytest.mark.usefixtures("few")
def test_csv_without_a_place_is_refused_before_the_work(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def worked(*_: object, **__: object) -> TimeHistory:
        raise AssertionError("marched before the place was checked")

    monkeypatch.setattr("microslip.studies.tables._march", worked)

    status, _, error = run("tables", "--csv", "nowhere/tables.csv")

    assert status == 2
    assert "nowhere" in error


@pytest.mark.slow
@pytest.mark.parametrize(
    ("variant", "low", "high"),
    [
        pytest.param(PAPER[0], 0.5, 1.5, marks=pytest.mark.long),
        # 1.7 mJ, as in tests/agreement/test_paper.py
        pytest.param(PAPER[2], 0.9885, 1.0115, marks=pytest.mark.long),
        (PAPER[3], 0.9885, 1.0115),
    ],
    ids=["full", "B", "A"],
)
def test_coulomb_rows_come_out_near_the_paper(
    variant: Variant, low: float, high: float
) -> None:
    (row,) = rows("two-blades", (variant,), halve=False)

    assert low < row.energy / variant.paper < high
    assert 0.0 < row.closing_error < 1e-3

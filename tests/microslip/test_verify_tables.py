"""What verify and frc say of stability, and of sweeps without friction."""

import dataclasses
import math

import numpy as np
import pytest

from microslip.commands.frc_events import events
from microslip.commands.frc_tables import rest, table
from microslip.commands.told_errors import amplitude, contacts
from microslip.commands.verify_findings import Findings, verdict
from microslip.commands.verify_marches import march_rows, marches_said
from microslip.commands.verify_orbits import orbit_rows, orbits_said
from microslip.commands.verify_sweeps import HELD, sweep_rows, sweeps_said
from microslip.studies.curve import Traced
from microslip.studies.verify.orbits import Verdict
from microslip.studies.verify.verify import SweepAgreement
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.static import StaticState
from small_problems import prescribed
from timedomain.shooting.comparison import Comparison
from timedomain.verify import Agreement

UNMOVED = prescribed(4.0 * math.tau)


def left(deviation: float, unstable: int) -> Agreement:
    """Return a march at 4 Hz that ends so far off."""
    predicted = np.array([2e-3])
    marched = predicted * (1.0 + deviation)
    return Agreement(4.0 * math.tau, predicted, marched, 0.0, 0.0, 0.0, 0.0, unstable)


def swept(slower: float, energy: float) -> SweepAgreement:
    """Return a sweep of which friction takes so much, and as much is predicted."""
    none = np.zeros(0)
    return SweepAgreement(slower, energy, energy, 0.1 / slower, 1e-6, none, none)


def test_small_energies_keep_their_digits() -> None:
    small, large = sweep_rows([swept(1.0, 2.34e-8)]), sweep_rows([swept(1.0, 0.25)])

    assert small.count(" 2.340e-08 ") == 2
    assert large.count(" 0.250000 ") == 2


def test_marches_from_unstable_orbits_prove_nothing_and_refute_nothing() -> None:
    said, stays = marches_said([left(0.5, 1), left(0.9, 2)], ["x"], 1e-3)

    assert stays
    assert said == "every orbit is unstable: no march needs to stay near one"


def test_marches_of_unknown_stability_decide_as_stable_ones_do() -> None:
    _, stays = marches_said([left(0.5, -1)], ["x"], 1e-3)

    assert not stays


@pytest.mark.parametrize(("far", "stays"), [(9e-4, True), (2e-3, False)])
def test_marches_from_stable_orbits_decide(far: float, stays: bool) -> None:
    said, found = marches_said([left(0.5, 1), left(far, 0)], ["x"], 1e-3)

    assert found is stays
    assert said.startswith("agree: " if stays else "DISAGREE: ")
    assert f"of 1 stable orbits {100.0 * far:.3g} % at 4.0000 Hz" in said


def test_sweeps_without_friction_have_no_columns_of_its_energy() -> None:
    rubbing, free = ([swept(one, taken) for one in (1.0, 4.0)] for taken in (2.0, 0.0))

    assert "friction" in sweep_rows(rubbing)
    assert "friction" not in sweep_rows(free)
    widths = {len(line) for line in sweep_rows(free).splitlines()[1:]}
    assert max(widths) - min(widths) < 3
    landed = [*rubbing[:-1], dataclasses.replace(rubbing[-1], chosen=(68.6219,))]
    assert "beyond 68.6219 Hz more than one branch is stable" in sweep_rows(landed)
    assert "more than one branch" not in sweep_rows(rubbing)
    assert sweeps_said(rubbing, agree=True).startswith("agree: energy and envelope of")
    assert sweeps_said(rubbing, agree=True, holds=True).count("\n") == 0
    held = sweeps_said(rubbing, agree=False, holds=True).splitlines()
    assert held[0].startswith("DISAGREE: ")
    assert held[1:] == ["all may be too fast: --slower 16 64 tells more", HELD]
    assert sweeps_said(free, agree=False).splitlines()[0] == (
        "DISAGREE: envelope of the sweep does not approach the curve as it slows"
    )


@pytest.mark.parametrize(
    ("unstable", "text"),
    [
        ([0, 0, 0, 0], "every point is stable"),
        ([0, 0, -1, 0], "3 of 4 points are stable, of the others the stability is not"),
        ([-1, -1, -1, -1], "stability is not known: there are no Floquet mult"),
        ([0, -1, 1, 2], "unstable at 2 of 4 points, between 133.0000 and 134.0000 Hz"),
        ([0, -1, 1, 2], "; not known of 1"),
    ],
)
def test_what_is_known_of_stability_is_said(
    unstable: list[int], text: str, small_curve: ResponseCurve
) -> None:
    curve = dataclasses.replace(small_curve, unstable=np.array(unstable, dtype=float))

    assert text in events(curve)


@pytest.mark.parametrize(
    ("largest", "said"),
    [(1.0 + 2.34e-5, "1.000023"), (1.0 + 1.1e-5, "1.000011"), (3.5, "3.5000")],
)
def test_a_multiplier_outside_the_circle_is_not_said_to_be_one(
    largest: float, said: str, small_curve: ResponseCurve
) -> None:
    curve = dataclasses.replace(
        small_curve,
        unstable=np.array([0.0, 0.0, 1.0, 0.0]),
        multiplier=np.array([0.9, 0.8, largest, 0.7]),
    )

    assert events(curve).endswith(f"multiplier {said}")
    assert events(curve, doubt=2.3e-6).endswith(f"multiplier {said} ± 2e-06")


def test_events_and_errors_are_told_in_the_units_beside_them(
    small_curve: ResponseCurve,
) -> None:
    known = math.tau * np.array([math.nan, 2e-3, 3e-4, math.nan])
    curve = dataclasses.replace(
        small_curve, parameter_error=known, error=np.array([1e-4, 2e-3, 5e-4, 1e-3])
    )

    said = events(curve)
    assert "131.000000 Hz \N{PLUS-MINUS SIGN} 0.002 " in said
    assert "133.000000 Hz \N{PLUS-MINUS SIGN} 0.0003 " in said
    assert "mm \N{PLUS-MINUS SIGN} 0.2 %" in said
    assert "at most 0.2 % at a point, 0.075 % in the median" in amplitude(curve)
    one = dataclasses.replace(curve, harmonics=np.ones(4), samples=np.full(4, 64.0))
    assert amplitude(one).endswith("; 1 harmonic, 64 samples")


def test_errors_of_contacts_are_told_with_what_they_are_over(
    small_curve: ResponseCurve,
) -> None:
    curve = dataclasses.replace(
        small_curve,
        friction_energy=np.array([1e-6, 4e-4, 2e-4, 0.0]),
        friction_energy_error=np.array([1e-8, 8e-6, math.inf, 4e-7]),
        damping_energy=np.zeros(4),
        normal_error=np.array([[1e-3, 0.02, 0.0]] * 3 + [[math.inf] * 3]),
    )

    assert contacts(curve) == [
        "estimated error of what friction takes out: at most 2 % of its largest, "
        "0.1 % in the median",
        "estimated error of normal forces: at most 0.02 N, 0.02 N in the median",
    ]
    unknown = dataclasses.replace(
        curve,
        friction_energy_error=np.full(4, math.nan),
        normal_error=np.full((4, 3), math.nan),
    )
    assert contacts(unknown) == []
    rounded = dataclasses.replace(
        unknown,
        damping_energy=np.full(4, 1e-18),
        damping_energy_error=np.full(4, 1e-19),
        normal_error=np.full((4, 3), 1e-13),
    )
    assert contacts(rounded) == []


def test_the_table_of_a_curve_is_in_the_units_of_its_head(
    small_curve: ResponseCurve,
) -> None:
    rest = StaticState(np.zeros(1), np.zeros(2), 0.0, 1)
    row = table(Traced(small_curve, (), rest)).splitlines()[2].split()

    shown = [float(each) for each in row if each != "largest"]
    probes = 1e3 * small_curve.amplitude[0, :3]
    forces = small_curve.normal_smallest[0].min(), small_curve.normal_largest[0].max()
    energy = 1e3 * small_curve.friction_energy[0]
    assert shown == pytest.approx([130.0, *probes, energy, *forces], rel=5e-3)


@pytest.mark.parametrize(
    ("force", "said"), [(2.9237, "2.924"), (1e-6, "1.000e-06"), (0.0, "0.000")]
)
def test_forces_at_rest_keep_their_digits(
    force: float, said: str, small_curve: ResponseCurve
) -> None:
    state = StaticState(np.zeros(1), np.array([force, 0.0, 0.0]), 0.0, 1)

    told = rest(small_curve, state)

    assert told.startswith(
        f"normal force at rest [N]: {small_curve.contacts[0]} {said}"
    )


def test_a_curve_that_came_back_is_told_from_the_one_that_follows(
    small_curve: ResponseCurve,
) -> None:
    hertz = 2.0 * np.pi * np.array([130.0, 131.0, 130.0, 134.0])
    events_there = ("", "fold", "", "restart")
    curve = dataclasses.replace(small_curve, frequency=hertz, event=events_there)
    said = "what begins at 134.000000 Hz is a curve of its own: the one before came"

    assert said in events(curve)
    hertz[2] = 2.0 * np.pi * 132.0
    assert said not in events(curve)


def test_what_comes_in_from_beyond_the_end_is_told_from_the_curve_before(
    small_curve: ResponseCurve,
) -> None:
    hertz = 2.0 * np.pi * np.array([130.0, 134.0, 134.0, 133.0])
    events_there = ("", "", "restart", "fold")
    curve = dataclasses.replace(small_curve, frequency=hertz, event=events_there)
    said = "what begins at 134.000000 Hz comes in from beyond the range: a response"

    assert said in events(curve)
    hertz[2] = 2.0 * np.pi * 130.0
    assert said.replace("134", "130") in events(curve)
    hertz[2] = 2.0 * np.pi * 133.5
    assert "begins" not in events(curve)
    # besides a curve of its own, which has begun there
    hertz[:3] = 2.0 * np.pi * np.array([130.0, 130.0, 134.0])
    ending = ("", "", "restart", "restart")
    hertz[3] = hertz[2]
    curve = dataclasses.replace(curve, frequency=hertz, event=ending)
    assert events(curve).count(said) == 1


def compared(response: PeriodicResponse, size: Array) -> Comparison:
    """Return an orbit of such amplitudes [m], by both solvers."""
    return Comparison(
        response, size, size, 1e-4, 1e-4, np.zeros(2), 0.0, 0.2, 1e-3, 1024
    )


@pytest.mark.parametrize(
    ("size", "shown"), [(2e-3, "  2.000000"), (4e-9, " 4.000e-06")]
)
def test_the_amplitude_is_that_of_a_probe_that_moves(size: float, shown: str) -> None:
    made = compared(UNMOVED, size * np.array([1e-14, 1.0, 1.5]))
    march = dataclasses.replace(left(0.0, 0), predicted=made.found, marched=made.found)

    orbits = orbit_rows([Verdict(UNMOVED, "stable", made, "")])
    marches = march_rows([march], ["still", "x", "y"])

    assert f"   4.0000 {shown} {shown}  " in orbits
    assert f"   4.0000 {shown}  " in marches


def test_orbits_and_marches_tell_near_and_slow_frequencies_apart() -> None:
    hertz = (2e-4, 2.002e-4)
    near = [dataclasses.replace(UNMOVED, frequency=math.tau * each) for each in hertz]
    orbits = [
        Verdict(each, "stable", compared(each, np.array([1e-3])), "") for each in near
    ]
    marches = [
        dataclasses.replace(left(0.0, 0), frequency=f)
        for f in math.tau * np.array(hertz)
    ]

    texts = ["0.0002000000", "0.0002002000"]
    for rows in (orbit_rows(orbits), march_rows(marches, ["x"])):
        assert [line.split()[0] for line in rows.splitlines()[-2:]] == texts
    assert f"at {texts[0]} Hz" in orbits_said(orbits)
    apart = [dataclasses.replace(each, cause="so") for each in orbits]
    said = orbits_said(apart).splitlines()
    assert [line.split(" Hz")[0] for line in said[:2]] == [
        f"DISAGREE at {each}" for each in texts
    ]
    assert f"at {texts[0]} Hz" in marches_said(marches, ["x"], 1e-3)[0]


@pytest.mark.parametrize(
    ("unstable", "shown"), [(-1, ["-", "0.2000"]), (0, ["0.0000"])]
)
def test_a_multiplier_that_is_not_known_has_no_number(
    unstable: int, shown: list[str]
) -> None:
    multipliers = np.empty(0, complex) if unstable < 0 else np.zeros(1, complex)
    response = dataclasses.replace(UNMOVED, multipliers=multipliers)
    made = compared(response, np.array([1e-3]))

    row = orbit_rows([Verdict(response, "stable", made, "")]).splitlines()[-1]

    assert row.split()[6 : 6 + len(shown)] == shown


@pytest.mark.parametrize(("deviation", "status"), [(5e-4, 0), (0.5, 1)])
def test_a_march_that_leaves_its_orbit_ends_verify_with_one(
    deviation: float, status: int
) -> None:
    found = Findings(("x",), marches=[left(deviation, 0)])

    assert verdict(found, 1e-3) == status


def test_orbits_beyond_both_estimates_end_verify_with_one() -> None:
    lost = Verdict(UNMOVED, "", None, "")
    assert verdict(Findings(("x",), orbits=[lost]), 1e-3) == 0
    found = Findings(("x",), orbits=[lost] * 2)
    assert verdict(found, 1e-3) == 1

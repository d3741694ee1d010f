"""Reference problems: published and closed-form answers against microslip's own."""

import pytest

from references.catalogue import findings
from references.finding import Finding


@pytest.fixture(scope="module")
def found() -> list[Finding]:
    """Return all findings: one call, the JIT counts."""
    return list(findings())


def test_every_known_number_is_met_within_its_tolerance(found: list[Finding]) -> None:
    missed = [each for each in found if not each.holds]

    assert not missed


def test_eight_systems_are_known_from_elsewhere(found: list[Finding]) -> None:
    assert len({each.system for each in found}) >= 8
    assert all(each.source and each.tolerance <= 1e-2 for each in found)

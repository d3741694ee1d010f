"""Numbers in columns: digits that are left of small ones."""

import numpy as np
import pytest

from microslip.commands.columns import decimal, even, hertz, tabled


@pytest.mark.parametrize(
    ("value", "largest", "text"),
    [
        (0.25, 0.4, "   0.25000"),
        (-1e-9, 0.4, "   0.00000"),
        (0.0012, 0.0012, "   0.00120"),
        (0.00012, 0.0004, " 1.200e-04"),
        (0.0, 0.0004, " 0.000e+00"),
        (0.0, 0.0, "   0.00000"),
        (-1e-22, 6e-22, "   0.00000"),
        (1234.5, 9999.0, "1234.50000"),
        (1234.5, 12345.6, " 1.234e+03"),
        (4e119, 4e119, "4.000e+119"),
    ],
)
def test_small_columns_have_powers_of_ten(
    value: float, largest: float, text: str
) -> None:
    assert decimal(value, largest, 5) == text


@pytest.mark.parametrize(
    ("seen", "texts"),
    [
        ([125.0, 145.0], ["125.0000", "145.0000"]),
        ([5.5, 5.5002], ["5.5000000", "5.5002000"]),
        ([2e-5, 9e-4], ["0.0000200", "0.0009000"]),
        ([135.0, 135.0 + 1e-9], ["135.0000", "135.0000"]),
        ([0.0], ["0.0000"]),
        ([2.5e6, 3.123456789e6], ["2500000.000", "3123456.789"]),
        ([1e9, 1e9 + 2e4], ["1000000000.0000", "1000020000.0000"]),
    ],
)
def test_frequencies_are_told_apart(seen: list[float], texts: list[str]) -> None:
    assert [hertz(each, seen) for each in seen] == texts


@pytest.mark.parametrize(
    ("values", "texts"),
    [
        ([0.01, 12.3], ["  0.01000", " 12.30000"]),
        ([1e-4, 12.3], ["1.000e-04", "1.230e+01"]),
        ([0.0, 12.3], ["  0.00000", " 12.30000"]),
        ([0.5, 2e3], ["5.000e-01", "2.000e+03"]),
    ],
)
def test_a_column_has_one_notation(values: list[float], texts: list[str]) -> None:
    assert even(values, 5, 9) == texts


def test_tables_have_the_probes_that_move_most_of_many() -> None:
    names = ["a", "b", "c", "d", "a-to-b"]

    assert tabled(names, np.array([1.0, 3.0, 2.0, 4.0, 9.0])) == [1, 2, 3]
    assert tabled(["a", "b", "a-to-b"], np.array([1.0, 2.0, 9.0])) == [0, 1, 2]

"""Picture of the stress matrix: rows of values, or parameters with one value each."""

from microslip.figures.stress import Cell, stress_figure

OUTCOMES = {"agrees": 3, "disagrees": 1}


def texts(cells: list[Cell]) -> dict[str, tuple[float, float]]:
    """Return where each text of the picture stands, by what it says."""
    figure = stress_figure(cells, OUTCOMES, "a matrix")
    figure.draw_without_rendering()
    (axes,) = figure.axes
    return {each.get_text(): each.get_position() for each in axes.texts}


def test_values_of_a_parameter_stand_in_its_row() -> None:
    found = texts([Cell("mu", str(each), "agrees", "1e-03") for each in range(4)])

    assert [found[str(each)][0] for each in range(4)] == [0.5, 1.5, 2.5, 3.5]
    assert len({found[str(each)][1] for each in range(4)}) == 1


def test_parameters_of_one_value_stand_side_by_side_and_are_named() -> None:
    lone = [Cell(name, "1", "agrees", "") for name in ("mu", "sigma", "rope", "mass")]
    row = [Cell("nan", f"table {each}", "disagrees", "") for each in range(6)]

    found = texts([*lone, *row])

    assert found["mu: 1"] == (1.0, 0.5)
    assert found["rope: 1"] == (5.0, 0.5)
    assert found["mass: 1"] == (1.0, 1.5)
    assert found["table 0"] == (0.5, 2.5)


def test_nothing_tried_makes_a_picture_too() -> None:
    assert texts([]) == {}

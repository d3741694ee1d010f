"""Picture of a matrix of cases: a row for each parameter, a cell for each value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from microslip.figures.style import literal

SHADES = ("#009E73", "#9BD4B5", "#E69F00", "#C0392B", "#B8C4D0")
"""of outcomes in their order, from the best one"""
UNTRIED = "#FFFFFF"


@dataclass(frozen=True, slots=True)
class Cell:
    """One case."""

    parameter: str
    value: str
    outcome: str
    """one of those that the picture is given; empty if it has not been tried"""
    note: str
    """a second line in the cell"""


def stress_figure(
    cells: Sequence[Cell], outcomes: Mapping[str, int], title: str
) -> Figure:
    """Draw the cells; ``outcomes`` counts each of them, the best first."""
    rows: dict[str, list[Cell]] = {}
    for cell in cells:
        rows.setdefault(cell.parameter, []).append(cell)
    longest = max((len(row) for row in rows.values()), default=1)
    figure = Figure(
        figsize=(2.2 + 1.0 * longest, 1.3 + 0.42 * len(rows)), layout="constrained"
    )
    axes = figure.subplots()
    colours = dict(zip(outcomes, SHADES, strict=False))
    for height, row in enumerate(rows.values()):
        for place, cell in enumerate(row):
            colour = colours.get(cell.outcome, UNTRIED)
            axes.add_patch(
                Rectangle((place, height), 1.0, 1.0, facecolor=colour, edgecolor="w")
            )
            _write(axes, place + 0.5, height + 0.5, cell)
    axes.set_xlim(0.0, longest)
    axes.set_ylim(len(rows), 0.0)
    axes.set_xticks([])
    axes.set_yticks([each + 0.5 for each in range(len(rows))], list(rows), fontsize=8)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    figure.suptitle(literal(title), fontsize="medium")
    figure.legend(
        handles=[
            Patch(facecolor=colours[name], label=f"{name} ({count})")
            for name, count in outcomes.items()
        ],
        loc="outside lower center",
        ncols=len(outcomes),
        frameon=False,
        fontsize=8,
    )
    return figure


def _write(axes: Axes, across: float, down: float, cell: Cell) -> None:
    """Write value and note into a cell, about its middle."""
    apart = 0.2 if cell.note else 0.0
    for text, place, weight in (
        (cell.value, down - apart, "bold"),
        (cell.note, down + apart, "normal"),
    ):
        axes.text(
            across, place, text, ha="center", va="center", fontsize=7.5, weight=weight
        )

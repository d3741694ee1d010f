"""Picture of a matrix of cases: a row for each parameter, a cell for each value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from microslip.figures.style import (
    headline,
)

SHADES = ("#009E73", "#9BD4B5", "#E69F00", "#C0392B", "#B8C4D0")
"""of outcomes in their order, from the best one"""
UNTRIED = "#FFFFFF"
SINGLE, WIDE, LEAST = 2, 2, 8
"""rows of one cell that stay rows; width of others, and of a picture of them alone"""


@dataclass(frozen=True, slots=True)
class Cell:
    """One case."""

    parameter: str
    value: str
    outcome: str
    """one of those that the picture is given; empty if it has not been tried"""
    note: str
    """a second line in the cell"""


@dataclass(frozen=True, slots=True)
class Tile:
    """A rectangle of the picture."""

    cell: Cell
    left: int
    top: int
    width: int
    text: str
    """its first line"""


def stress_figure(
    cells: Sequence[Cell], outcomes: Mapping[str, int], title: str
) -> Figure:
    """Draw the cells; ``outcomes`` counts each of them, the best first.

    A row for each parameter. Where several have but one value, these stand side by
    side above the rows, the parameter named in each.
    """
    rows: dict[str, list[Cell]] = {}
    for cell in cells:
        rows.setdefault(cell.parameter, []).append(cell)
    lone = [row[0] for row in rows.values() if len(row) == 1]
    if len(lone) <= SINGLE:
        lone = []
    others = [row for row in rows.values() if row[0] not in lone]
    longest = max((len(row) for row in others), default=LEAST)
    across = longest // WIDE
    first = -(-len(lone) // across) if lone else 0
    tiles = [*_alone(lone, across), *_in_rows(others, first)]
    figure = Figure(
        figsize=(2.2 + 1.0 * longest, 1.3 + 0.42 * (first + len(others))),
        layout="constrained",
    )
    axes = figure.subplots()
    colours = dict(zip(outcomes, SHADES, strict=False))
    for tile in tiles:
        _draw(axes, tile, colours.get(tile.cell.outcome, UNTRIED))
    _name(axes, [row[0].parameter for row in others], first, longest)
    headline(figure, title)
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


def _alone(cells: Sequence[Cell], across: int) -> list[Tile]:
    """Return the only cells of their rows, so many side by side."""
    return [
        Tile(
            cell,
            WIDE * (number % across),
            number // across,
            WIDE,
            f"{cell.parameter}: {cell.value}",
        )
        for number, cell in enumerate(cells)
    ]


def _in_rows(rows: Sequence[Sequence[Cell]], first: int) -> list[Tile]:
    """Return the cells of rows that begin below the ``first`` ones."""
    return [
        Tile(cell, place, first + height, 1, cell.value)
        for height, row in enumerate(rows)
        for place, cell in enumerate(row)
    ]


def _draw(axes: Axes, tile: Tile, colour: str) -> None:
    """Draw a rectangle with its text and note about its middle."""
    corner = tile.left, tile.top
    axes.add_patch(Rectangle(corner, tile.width, 1.0, facecolor=colour, edgecolor="w"))
    apart = 0.2 if tile.cell.note else 0.0
    for text, place, weight in (
        (tile.text, -apart, "bold"),
        (tile.cell.note, apart, "normal"),
    ):
        axes.text(
            tile.left + 0.5 * tile.width,
            tile.top + 0.5 + place,
            text,
            ha="center",
            va="center",
            fontsize=7.5,
            weight=weight,
        )


def _name(axes: Axes, names: Sequence[str], first: int, width: int) -> None:
    """Name the rows that begin below the ``first`` ones."""
    last = first + len(names)
    axes.set_xlim(0.0, width)
    axes.set_ylim(max(last, 1), 0.0)
    axes.set_xticks([])
    axes.set_yticks([each + 0.5 for each in range(first, last)], names, fontsize=8)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)

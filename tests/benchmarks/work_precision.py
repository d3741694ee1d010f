"""What a ladder of settings costs and how wrong it is: fronts, tables, a picture."""

from __future__ import annotations

import csv
import dataclasses
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.style import COLOURS, STYLES, framed

Setting = tuple[float, ...]
"""a step, or a relative tolerance and the absolute one's share of it"""
OURS = "microslip"
"""how names of the product's own methods begin"""


@dataclasses.dataclass(frozen=True, slots=True)
class Run:
    """One march of one method."""

    name: str
    setting: Setting
    cost: float
    """CPU seconds per simulated second"""
    error: float
    closing: float
    success: bool


def row(run: Run) -> str:
    """Return a line of a table."""
    setting = "  ".join(f"{value:8.1e}" for value in run.setting)
    said = "success" if run.success else "failure"
    return (
        f"{run.name:18s}  {setting:18s}{run.cost:9.3f} CPU s/s  error {run.error:8.1e}"
        f"  closing error {run.closing:8.1e}  {said}"
    )


def front(runs: Sequence[Run]) -> list[Run]:
    """Return the runs that no other one beats in both cost and error, by cost."""
    kept: list[Run] = []
    for run in sorted(runs, key=lambda each: each.cost):
        if np.isfinite(run.error) and (not kept or run.error < kept[-1].error):
            kept.append(run)
    return kept


def cost_at(runs: Sequence[Run], asked: float) -> float:
    """Return the interpolated cost at an error; NaN if no run is as good."""
    best = front(runs)
    good = [place for place, run in enumerate(best) if run.error <= asked]
    if not good:
        return float("nan")
    if good[0] == 0:
        return best[0].cost
    loose, tight = best[good[0] - 1], best[good[0]]
    errors, costs = np.log([[r.error, r.cost] for r in (tight, loose)]).T
    return float(np.exp(np.interp(np.log(asked), errors, costs)))


def written(runs: Sequence[Run], path: Path) -> None:
    """Write all runs as a table."""
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow([field.name for field in dataclasses.fields(Run)])
        for run in runs:
            setting = " ".join(f"{value:g}" for value in run.setting)
            values = (run.cost, run.error, run.closing)
            shown = (f"{value:.6g}" for value in values)
            table.writerow([run.name, setting, *shown, run.success])


def drawn(runs: Sequence[Run], title: str, path: Path) -> None:
    """Draw cost by error of all methods; a line joins the best runs of each."""
    figure = Figure(figsize=(9.0, 5.0), layout="constrained")
    axes = figure.subplots()
    outsiders, own = iter(COLOURS * len(runs)), iter(STYLES * len(runs))
    for name in dict.fromkeys(run.name for run in runs):
        ours = name.startswith(OURS)
        look = ("0.15", next(own)) if ours else (next(outsiders), "-")
        those = [run for run in runs if run.name == name and np.isfinite(run.error)]
        _line(axes, those, "o", colour=look[0], size=2.0, label="")
        _line(axes, front(those), "o" + look[1], colour=look[0], size=4.0, label=name)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.invert_xaxis()
    framed(
        axes,
        x="error of the energy taken out by friction",
        y="CPU s per simulated s",
        title=title,
    )
    axes.margins(x=0.04)
    figure.legend(loc="outside right upper", frameon=False)
    figure.savefig(path, dpi=150)


def _line(
    axes: Axes,
    runs: Sequence[Run],
    style: str,
    *,
    colour: str,
    size: float,
    label: str,
) -> None:
    errors, costs = [run.error for run in runs], [run.cost for run in runs]
    axes.plot(errors, costs, style, color=colour, markersize=size, label=label)

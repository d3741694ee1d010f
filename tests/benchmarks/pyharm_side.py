"""pyHarm's side of pyharm.py: run by the interpreter that has pyHarm-os.

Reads cases as JSON from standard input and writes what was measured to standard output.
Times are of this process, of its second and later runs.
"""

from __future__ import annotations

import contextlib
import json
import logging
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

SUBSTRUCTURE = "all"


def main() -> None:
    """Answer all cases."""
    logging.disable(logging.CRITICAL)
    cases = json.load(sys.stdin)
    with contextlib.redirect_stdout(sys.stderr):
        answers = [answer(case) for case in cases]
    json.dump(answers, sys.stdout)


def answer(case: dict[str, Any]) -> dict[str, Any]:
    """Return the best curve of the solvers asked for, or one evaluation."""
    if "point" in case:
        return evaluated(case)
    found = [traced(case, solver) for solver in case["solvers"]]
    return min(found, key=lambda each: each["seconds"])


def maestro(case: dict[str, Any], solver: str) -> Any:
    """Return pyHarm's front end for a case."""
    from pyHarm.Maestro import Maestro

    matrices = {name: np.array(case[name]) for name in "MCK"}
    return Maestro(
        {
            "system": {"type": "Base", "nh": case["harmonics"], "nti": case["samples"]},
            "substructures": {
                SUBSTRUCTURE: {"matrix": matrices, "ndofs": case["motions"]}
            },
            "connectors": {
                f"element-{number}": connector(*each)
                for number, each in enumerate(case["elements"])
            },
            "analysis": {"curve": {"study": "frf", "solver": solver, **case["steps"]}},
        }
    )


def connector(kind: str, nodes: list[int], numbers: dict[str, Any]) -> dict[str, Any]:
    """Return an element in pyHarm's words: between two nodes, or one and the ground."""
    ends = {SUBSTRUCTURE: [nodes[0]]}
    if len(nodes) > 1:
        ends["INTERNAL"] = [nodes[1]]
    return {"type": kind, "connect": ends, "dirs": [0], **numbers}


def traced(case: dict[str, Any], solver: str) -> dict[str, Any]:
    """Return the curve by one solver, and CPU seconds per accepted point."""
    seconds, points = [], []
    for _ in range(1 + case["repeats"]):
        front = maestro(case, solver)
        began = time.process_time()
        front.operate()
        spent = time.process_time() - began
        points = [each for each in front.nls["curve"].SolList if each.flag_accepted]
        seconds.append(spent / len(points))
    order = places(front.system)
    return {
        "solver": solver,
        "seconds": statistics.median(seconds[1:]),
        "points": len(points),
        "tried": len(front.nls["curve"].SolList),
        "reached": max(float(each.x[-1]) for each in points),
        "curve": [[*each.x[order].tolist(), float(each.x[-1])] for each in points],
    }


def evaluated(case: dict[str, Any]) -> dict[str, Any]:
    """Write residual and Jacobian at one point; return CPU seconds for both."""
    system = maestro(case, "NewtonRaphson").system
    order = places(system)
    point = np.zeros(order.size + 1)
    point[order], point[-1] = case["point"], case["frequency"]

    def run() -> tuple[Any, Any]:
        return system.Residual(point), system.Jacobian(point)[0]

    run()
    residual, jacobian = run()
    np.save("residual.npy", residual[order])
    np.save("jacobian.npy", jacobian[np.ix_(order, order)])
    return {"seconds": median(run, case["repeats"])}


def places(system: Any) -> Any:
    """Return where a₀ of all degrees of freedom are, then a₁, b₁, …."""
    table = system.expl_dofs.reset_index()
    table = table.sort_values(["harm", "cs", "node_num", "dof_num"])
    return table["index"].to_numpy()


def median(run: Callable[[], object], times: int) -> float:
    """Return the median CPU time of several runs."""
    found = []
    for _ in range(times):
        began = time.process_time()
        run()
        found.append(time.process_time() - began)
    return statistics.median(found)


if __name__ == "__main__":
    main()

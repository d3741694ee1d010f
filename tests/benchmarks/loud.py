"""Do loud motions of the full rig with falling friction die down to its curve?

A drive of 4 N is lowered step by step to the scene's 1 N, at frequencies over the whole
range and more near resonance. A stable response beside the curve that a loud motion
reaches would keep it. Run: ``python tests/benchmarks/loud.py``.
"""

from dataclasses import replace

import numpy as np

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.api.scene import scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response_curve import response_curve
from microslip_mechanics.static import static_equilibrium
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import Start

TURN = 2.0 * np.pi
SPREAD = 125.0 + 20.0 * (np.arange(15) + 0.5) / 15.0
NEAR = np.array([134.5, 134.9, 135.1, 135.3])
LEVELS = ((4.0, 150), (2.8, 60), (2.0, 60), (1.5, 60), (1.2, 60), (1.0, 300))
"""drive over that of the scene, and periods"""
ROWS = 60
"""per period"""


def main() -> None:
    problem = scene("two-blades", ["model=full", "friction.law=gkf"])
    rest = static_equilibrium(problem)
    options = CurveOptions(TURN * 125.0, TURN * 145.0)
    points = list(frequency_response(problem, rest, options))
    curve = response_curve(problem, points, "complete")
    print("  Hz      loud [mm]  at last [mm]  curve [mm]  unstable there")
    for hertz in np.sort(np.concatenate([SPREAD, NEAR])):
        loud, last = amplitudes(problem, rest.displacement, TURN * hertz)
        known = np.interp(TURN * hertz, curve.frequency, curve.amplitude[:, 0])
        nearest = points[int(np.abs(curve.frequency - TURN * hertz).argmin())]
        print(
            f"{hertz:7.3f} {1e3 * loud:10.4f} {1e3 * last:12.5f} {1e3 * known:12.5f}"
            f" {nearest.unstable:6d}",
            flush=True,
        )


def amplitudes(problem: Problem, rest: Array, frequency: float) -> tuple[float, float]:
    """Return the amplitude at the largest drive, and at the last."""
    period, seen = TURN / frequency, []
    start = Start(rest, np.zeros_like(rest))
    for level, periods in LEVELS:
        (block,) = integrate(
            replace(problem, drive=level * problem.drive),
            Dwell(frequency, periods * period),
            MarchOptions(period / ROWS, 1, tolerance=1e-3),
            start=start,
            block=periods * period,
        )
        assert block.checkpoint is not None
        start = Start(block.checkpoint.displacement, block.checkpoint.velocity)
        turn = np.exp(-1j * frequency * block.time[-ROWS:])
        seen.append(2.0 * float(np.abs((block.displacement[-ROWS:, 0] * turn).mean())))
    return seen[0], seen[-1]


if __name__ == "__main__":
    main()

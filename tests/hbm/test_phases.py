"""Forces of different phases: the response of a linear system, solved directly."""

import numpy as np
import pytest
import scipy.sparse

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.dampers import LinearDamper
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system

MASS = np.diag([1.0, 2.0, 1.5])
STIFFNESS = np.array([[40.0, -15.0, 0.0], [-15.0, 30.0, -5.0], [0.0, -5.0, 25.0]])
DAMPER = 0.7


@pytest.mark.parametrize("sparse", [False, True], ids=["dense", "sparse"])
def test_linear_response_to_forces_with_phases(sparse: bool) -> None:
    kind = scipy.sparse.csc_array if sparse else np.array
    problem = system(
        mass=kind(MASS),
        stiffness=kind(STIFFNESS),
        elements=[Element(LinearDamper(DAMPER), between=("x1", "x3"))],
        drive={"x1": 2.0, "x2": (1.0, np.pi / 2), "x3": (3.0, -0.4)},
    )
    options = CurveOptions(3.0, 6.0, harmonics=1, samples=16)

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    force = np.array([2.0, 1.0j, 3.0 * np.exp(-0.4j)])
    damping = DAMPER * np.outer([1.0, 0.0, -1.0], [1.0, 0.0, -1.0])
    for response in found[:: len(found) // 4]:
        s = 1j * response.frequency
        direct = np.linalg.solve(s**2 * MASS + s * damping + STIFFNESS, -1j * force)
        seen = response.seen(np.eye(3))
        made = seen[1] - 1j * seen[2]
        np.testing.assert_allclose(made, direct, rtol=1e-6)

"""Systems of two masses, drawn at random, whose curves fold again and again."""

import numpy as np

from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.polynomial_spring import PolynomialSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system


def random_system(seed: int) -> Problem:
    """Return two masses on springs with a stop, a slider and a spring that bends."""
    drawn = np.random.default_rng(seed)
    stiffness, coupling = drawn.uniform(200.0, 1500.0), drawn.uniform(50.0, 500.0)
    whole = np.array([[stiffness + coupling, -coupling], [-coupling, 2.0 * coupling]])
    drive = drawn.uniform(0.5, 5.0)
    size = drive / stiffness
    elements = [
        Element(
            UnilateralSpring(
                stiffness=drawn.uniform(0.5, 20.0) * stiffness,
                gap=drawn.uniform(0.2, 4.0) * size,
            ),
            ("a", "ground"),
        ),
        Element(
            Jenkins(
                stiffness=drawn.uniform(0.1, 1.0) * stiffness,
                limit=drawn.uniform(0.05, 0.5) * drive,
            ),
            ("b", "ground"),
        ),
        Element(
            PolynomialSpring(
                coefficients={
                    2: drawn.uniform(-0.3, 0.3) * stiffness / size,
                    3: drawn.uniform(0.0, 0.3) * stiffness / size**2,
                }
            ),
            ("b", "ground"),
        ),
    ]
    return system(
        names=["a", "b"],
        mass=[1.0, drawn.uniform(0.3, 1.5)],
        stiffness=whole,
        damping_ratio=drawn.uniform(0.005, 0.03),
        elements=elements,
        drive={"a": drive},
    )

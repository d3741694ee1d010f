"""A mass on a spring that bends: its second harmonic is in resonance at half speed."""

from microslip_mechanics.element import Element
from microslip_mechanics.laws.polynomial_spring import PolynomialSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system


def bending_mass(square: float, cube: float, damping: float, drive: float) -> Problem:
    """Return a mass of 1 kg on a spring of 100 N/m that bends.

    Given are the coefficients of the second and the third degree [N/m², N/m³], the
    damping ratio and the drive [N].
    """
    spring = PolynomialSpring(coefficients={2: square, 3: cube})
    return system(
        names=["x"],
        mass=[1.0],
        stiffness=[[100.0]],
        damping_ratio=damping,
        elements=[Element(spring, ("x", "ground"))],
        drive={"x": drive},
    )

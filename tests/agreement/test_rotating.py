"""Coriolis forces in harmonic balance, in time, and by a direct solution."""

import dataclasses

import numpy as np
import pytest

from contact_tables import contact_points
from hbm.condensation import condense
from hbm.options import CurveOptions
from hbm.poles import poles
from hbm.solve import frequency_response
from hbm.stability import small_motions
from microslip_mechanics.arrays import Array
from microslip_mechanics.beam import RectangularSection
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.law import TWO_SIDED, PointLaw, contact_table
from microslip_mechanics.excitation import Dwell
from microslip_mechanics.frame import MOTIONS, Beam, Frame, Node
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.reduced_structure import craig_bampton
from microslip_mechanics.rotating_frame import RotatingFrame
from microslip_mechanics.rotation import Rotation
from microslip_mechanics.static import static_equilibrium
from timedomain.floquet import floquet_multipliers

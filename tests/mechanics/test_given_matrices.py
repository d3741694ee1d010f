"""Matrices as a user gives them: sparse ones are checked like dense ones."""

import re
from typing import Any

import numpy as np
import pytest
import scipy.sparse

from microslip_mechanics.structures.given_matrices import square_matrix

SHAPES = [
    np.ones((2, 3)),
    np.zeros((0, 0)),
    scipy.sparse.csr_array(np.ones((2, 3))),
    scipy.sparse.coo_array(np.ones(2)),
    scipy.sparse.csr_matrix((0, 0)),
]


@pytest.mark.parametrize("given", SHAPES)
def test_what_is_not_square_is_refused(given: Any) -> None:
    text = f"mass has shape {given.shape}: give a square matrix, or its diagonal"

    with pytest.raises(ValueError, match=f"^{re.escape(text)}$"):
        square_matrix(given, "mass")

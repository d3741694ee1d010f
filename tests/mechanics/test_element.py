"""Elements: tangents and rotations that are one motion are refused."""

import re
from typing import Any

import pytest

from microslip_mechanics.element import Element, interface_of
from microslip_mechanics.laws.area_contact import AreaContact
from microslip_mechanics.laws.elastic_friction import ElasticFriction

NAMES = ("x", "y", "z")
FRICTION = ElasticFriction(load=1.0, stiffness=3.0, mu=0.2)
AREA = AreaContact(stiffness=3.0, width=0.1, depth=0.2)
ALONG, BACK = ("x", "ground"), ("ground", "x")


@pytest.mark.parametrize(
    ("key", "element"),
    [
        ("tangents", {"law": FRICTION, "tangents": [ALONG, ALONG]}),
        ("tangents", {"law": FRICTION, "tangents": [ALONG, BACK]}),
        (
            "rotations",
            {"law": AREA, "normal": ("z", "ground"), "rotations": [ALONG, ALONG]},
        ),
    ],
)
def test_one_motion_is_not_counted_twice(key: str, element: dict[str, Any]) -> None:
    text = (
        f"element face: {key} are the same motion twice: give it once, or two that "
        "differ"
    )
    with pytest.raises(ValueError, match=f"^{re.escape(text)}$"):
        interface_of([Element(**element, name="face")], NAMES)


def test_tangents_oblique_to_a_motion_may_both_see_it() -> None:
    # 0.6 and 0.8 of one motion: together they slide as far as it goes.
    oblique = [({"x": 0.6}, "ground"), ({"x": 0.8}, "ground")]

    made = interface_of([Element(FRICTION, tangents=oblique, name="face")], NAMES)

    assert made.displacement[1:, 0].tolist() == [0.6, 0.8]

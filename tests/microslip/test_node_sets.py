"""Sets of nodes: an element and a load for each of them."""

import re
from pathlib import Path

import pytest

from microslip.scenes.quantity import SceneError
from scene_texts import NODES, made


def test_sets_make_an_element_and_a_load_for_each_node(tmp_path: Path) -> None:
    text = (
        NODES
        + """
[[element]]
name = "pair"
law = "cubic-spring"
each = ["left", "right"]
between = ["left.z", {"right.z" = 0.5}]
cubic = 10
[drive]
"left.x" = "2 N"
"3.x" = "1 N"
"""
    )

    problem = made(tmp_path, text)

    rows = problem.interface.displacement[[0, 3]]
    assert problem.interface.names == ("pair-1", "pair-2")
    assert rows.tolist() == [[0, 1, 0, 0, 0, -0.5], [0, 0, 0, 0.5, 0, 0]]
    assert problem.drive.tolist() == [2, 0, 2, 0, 1, 0]


PAIRED = """
[[element]]
name = "pair"
law = "cubic-spring"
each = ["left", "right"]
between = ["left.z", "right.z"]
cubic = 10
[drive]
"1.x" = 1
"""


def test_a_node_that_faces_two_others_has_an_element_for_each(tmp_path: Path) -> None:
    text = NODES.replace('left = ["1", "2"]', 'left = ["1", "1"]') + PAIRED

    first, second = made(tmp_path, text).interface.names

    assert first != second
    assert {first[:7], second[:7]} == {"pair-1-"}


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            '"right.z"]',
            '"ground"]',
            "no direction has an end of the set right, such as",
        ),
        ('["left", "right"]', '["twice", "twice"]', "1, 1 stand together twice: name"),
    ],
)
def test_sets_that_make_no_elements_of_their_own_are_refused(
    old: str, new: str, said: str, tmp_path: Path
) -> None:
    nodes = NODES.replace("[structure.sets]", '[structure.sets]\ntwice = ["1", "1"]')

    with pytest.raises(SceneError, match=re.escape(said)):
        made(tmp_path, nodes + PAIRED.replace(old, new))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"1", "2"', '"1", "4"', "sets: left: no degree of freedom is called '4'"),
        ("left", "3", "sets: 3 is the name of a node, too: name the set differently"),
    ],
)
def test_sets_of_unknown_nodes_or_called_like_one_are_refused(
    old: str, new: str, said: str, tmp_path: Path
) -> None:
    text = NODES.replace(old, new) + '[drive]\n"1.x" = 1\n'

    with pytest.raises(SceneError, match=re.escape(said)):
        made(tmp_path, text)


def test_a_set_of_one_node_may_have_its_name(tmp_path: Path) -> None:
    text = NODES.replace('left = ["1", "2"]', '1 = ["1"]')

    assert made(tmp_path, text + '[drive]\n"1.x" = 1\n').drive.tolist()[0] == 1.0

"""Scenes, and tables of scenes, that tests share."""

from pathlib import Path

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import built_in_text, load_scene
from microslip_mechanics.problem import Problem

NODES = """
scene = "system"
[structure]
names = ["1.x", "1.z", "2.x", "2.z", "3.x", "3.z"]
mass = [1, 1, 2, 2, 3, 3]
stiffness = [3e3, 1e3, 3e3, 1e3, 3e3, 1e3]
[structure.sets]
left = ["1", "2"]
right = ["3", "2"]
"""
EXPERIMENTS = """
[sweep]
ramp = 0
start = 0
end = "1 s"
duration = "1 s"
lowest = 4
highest = 7
[curve]
lowest = 4
highest = 7
tolerance = 1e-3
[march]
time_step = "1 ms"
store_every = 1
"""
"""what is done with a system around 5 Hz"""
BETWEEN_FACES = """
scene = "system"
[structure]
names = ["x", "z"]
mass = [1.0, 1.0]
stiffness = [100.0, 1.0]
damping = [0.5, 5.0]
[[element]]
name = "one"
law = "elastic-friction"
normal = ["z", "ground"]
tangents = [["x", "ground"]]
normal_stiffness = 300
preload = "10 N"
stiffness = 200
mu = 0.3
[[element]]
name = "other"
law = "elastic-friction"
normal = [{ z = -1.0 }, "ground"]
tangents = [["x", "ground"]]
normal_stiffness = 300
preload = "10 N"
stiffness = 200
mu = 0.3
[[element]]
name = "holds"
law = "jenkins"
between = ["z", "ground"]
stiffness = 400
limit = "40 N"
[drive]
x = "8 N"
[probes]
x = "x"
[curve]
lowest = "1.7 Hz"
highest = "1.9 Hz"
harmonics = 7
"""
"""a mass that rubs on two equal faces, held between them by a slider"""


def unswept(folder: Path) -> Path:
    """Write a scene without a sweep; return its file."""
    text = built_in_text("jenkins")
    begin, end = text.index("[sweep]"), text.index("[curve]")
    path = folder / "unswept.toml"
    path.write_text(text[:begin] + text[end:], encoding="utf-8")
    return path


def made(folder: Path, text: str) -> Problem:
    """Return the problem of a scene."""
    path = folder / "mine.toml"
    path.write_text(text + EXPERIMENTS, encoding="utf-8")
    return problem_of(load_scene(str(path)))

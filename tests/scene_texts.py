"""Scenes, and tables of scenes, that tests share."""

from pathlib import Path

from microslip.scenes.scene_file import built_in_text

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


def unswept(folder: Path) -> Path:
    """Write a scene without a sweep; return its file."""
    text = built_in_text("jenkins")
    begin, end = text.index("[sweep]"), text.index("[curve]")
    path = folder / "unswept.toml"
    path.write_text(text[:begin] + text[end:], encoding="utf-8")
    return path

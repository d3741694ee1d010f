"""The file of a march under way: begun with its first block, or gone on with."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from microslip.quantity import SceneError
from microslip.schema import Growing
from microslip.store import StoreError, begin, end_of, told
from microslip.stream import Stream


@dataclass(slots=True)
class Recording:
    """Where the blocks of a march go."""

    path: Path
    scene: str
    command: str
    stream: Stream | None = None

    @property
    def rows(self) -> int:
        """How many are written."""
        return self.stream.rows if self.stream else 0

    def keep(self, block: Growing) -> None:
        """Write a block; the first one begins the file."""
        if self.stream is None:
            self.stream = begin(
                self.path, block, scene=self.scene, command=self.command
            )
        with told(self.path):
            self.stream.append(block)

    def end(self, ending: str) -> None:
        """Write how the march ended."""
        if self.stream is not None:
            with told(self.path):
                self.stream.end(ending)


def resumed(path: Path, scene: str) -> tuple[Recording, Growing]:
    """Return the recording of a stopped march of this scene, and where it ended.

    Raises
    ------
    SceneError
        If the file is that of another scene.
    StoreError
        If the march of this file cannot go on.
    """
    end, head = end_of(path)
    if head.text("scene") != scene:
        raise SceneError(
            f"{path} is the march of another scene: give the scene and the overrides "
            f"of its command, {head.text('command')}"
        )
    if end.ending == "complete":
        raise StoreError(f"{path} is complete: there is nothing to resume")
    with told(path):
        return Recording(path, scene, "", Stream(path, head)), end

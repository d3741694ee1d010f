"""The file of a march under way: begun with its first block, or gone on with."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from microslip.files.result_file import end_of
from microslip.files.schema import Growing
from microslip.files.store import StoreError, WrongFileError, begin, told
from microslip.files.stream import Head, Stream, rows_of
from microslip.scenes.file_content import without_files
from microslip.scenes.quantity import SceneError
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.cycle_rows import parted
from microslip_mechanics.results.envelope import Envelope


@dataclass(slots=True)
class Recording:
    """Where the blocks of a march go; ``with`` it the file is closed in any case."""

    path: Path
    scene: str
    command: str
    head: Head | None = None
    """of a file that goes on"""
    stream: Stream | None = None

    def __enter__(self) -> Recording:
        return self

    def __exit__(self, *_: object) -> None:
        if self.stream is not None:
            self.stream.close()

    @property
    def rows(self) -> int:
        """How many are written."""
        return self.stream.rows if self.stream else 0

    def keep(self, block: Growing) -> None:
        """Write a block; the first one opens the file.

        Raises
        ------
        StoreError
            If it cannot be written, with what of the march stays in the file.
        """
        if self.stream is None:
            self.stream = self._opened(block)
        try:
            with told(self.path):
                self.stream.append(block)
        except StoreError as error:
            if not self.rows:
                raise
            raise StoreError(
                f"{error}: its {self.rows} rows so far stay, microslip plot draws them"
            ) from None

    def end(self, ending: str) -> None:
        """Write how the march ended."""
        if self.stream is not None:
            with told(self.path):
                self.stream.end(ending)

    def _opened(self, block: Growing) -> Stream:
        if self.head is None:
            return begin(self.path, block, scene=self.scene, command=self.command)
        with told(self.path):
            return Stream(self.path, self.head)


def resumed(path: Path, scene: str) -> tuple[Recording, Growing]:
    """Return the recording of a stopped march of this scene, and where it ended.

    Raises
    ------
    SceneError
        If the file is that of another scene.
    WrongFileError
        If the march of this file cannot go on.
    """
    end, head = end_of(path)
    _demand_same(path, head, scene)
    if end.ending == "complete":
        raise WrongFileError(
            f"{path} is complete: there is nothing to resume, microslip plot draws it"
        )
    return Recording(path, scene, head.text("command"), head), end


def last_state(path: Path, scene: str) -> tuple[Checkpoint, float]:
    """Return where a march of this scene stood at its end, and its drive's ω [rad/s].

    Raises
    ------
    SceneError
        If the file is that of another scene.
    WrongFileError
        If the file does not tell.
    """
    end, head = end_of(path)
    _demand_same(path, head, scene)
    if end.checkpoint is None or not head.rows or "frequency" not in head.growing:
        raise WrongFileError(f"{path} does not tell where its march ended: march anew")
    row = rows_of(path, head, head.rows - 1, 1)
    state = end.checkpoint
    if isinstance(end, Envelope):
        state, _ = parted(state)
    return state, float(row["frequency"][0])


def _demand_same(path: Path, head: Head, scene: str) -> None:
    own = head.text("scene")
    if own != scene and without_files(own) == without_files(scene):
        raise SceneError(
            f"{path} was marched with other content of the files that the scene names: "
            "put back what they held, or march anew"
        )
    if own != scene:
        raise SceneError(
            f"{path} is the march of another scene: give the scene and the overrides "
            f"of its command, {head.text('command')}"
        )

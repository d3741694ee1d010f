"""Stored curves that are compared, and what tells them apart."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from microslip.files.schema import kind_of
from microslip.files.store import Stored, WrongFileError
from microslip_mechanics.results.response_curve import ResponseCurve

OVERRIDE = "# --set "
"""what begins a line of a scene's text that tells of a value that was replaced"""
OWN = "the scene's own values"


def comparable(results: Sequence[Stored], files: Sequence[Path]) -> list[ResponseCurve]:
    """Return the curves of files, all along one quantity.

    Raises
    ------
    WrongFileError
        If a file holds something else.
    """
    curves: list[ResponseCurve] = []
    for each, file in zip(results, files, strict=True):
        curve = each.result
        if not isinstance(curve, ResponseCurve):
            raise WrongFileError(
                f"{file} holds a {kind_of(curve)[0]}: only curves are drawn together, "
                "those of frc, or of follow along one key"
            )
        curves.append(curve)
        if curve.along != curves[0].along:
            raise WrongFileError(
                f"{files[0]} goes along {curves[0].along or 'the frequency'}, {file} "
                f"along {curve.along or 'the frequency'}: draw them one by one"
            )
    return curves


def told_apart(results: Sequence[Stored], files: Sequence[Path]) -> list[str]:
    """Return what to call each result: the values of its scene that not all have.

    The names of their files stand for results of different scenes, of one and the
    same, and of Python.
    """
    scenes = {_scene(each.scene) for each in results}
    replaced = [_replaced(each.scene) for each in results]
    common = set.intersection(*(set(each.items()) for each in replaced))
    apart = [
        [
            f"{key} = {value}"
            for key, value in each.items()
            if (key, value) not in common
        ]
        for each in replaced
    ]
    labels = [", ".join(each) or OWN for each in apart]
    if len(scenes) == 1 and len(set(labels)) == len(labels):
        return labels
    return [each.stem for each in files]


def _scene(text: str) -> str:
    """Return the text of a scene without the values that were replaced."""
    lines = text.splitlines()
    return "\n".join(each for each in lines if not each.startswith(OVERRIDE)).strip()


def _replaced(text: str) -> dict[str, str]:
    """Return the values of a scene that were replaced, by their keys; the last ones."""
    found = {}
    for line in text.splitlines():
        if line.startswith(OVERRIDE):
            key, _, value = line.removeprefix(OVERRIDE).partition("=")
            found[key.strip()] = value.strip()
    return found

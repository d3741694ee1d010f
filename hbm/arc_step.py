"""One step of pseudo-arc-length continuation: predict, correct, settle (theory §6)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hbm.arc import distance, plane_across, tangent, turn
from hbm.corrected import lost, neglected
from hbm.correction import Correction, Outcome
from hbm.linearised import SingularError, System
from hbm.newton import Small, correct
from hbm.predictor import Predictor
from hbm.settler import Settler
from hbm.step_control import StepControl
from microslip_mechanics.arrays import Array

ASKEW = 0.7
"""cosine between the tangents of a step to a point with more harmonics, by which the
curve turns where fewer have just begun to mislead; one that turns more is at a corner
"""
THROWN = 10.0
"""times its length by which a step moves a point that it throws beyond a corner"""


def next_point(
    system: System,
    past: Predictor,
    direction: Array,
    scale: Array,
    step: float,
    control: StepControl,
    settler: Settler,
) -> tuple[Correction, float]:
    """Return the next point and the step that led to it.

    Raises
    ------
    ContinuationError
        If the shortest step does not converge either.
    """
    failures = 0
    while True:
        predicted = past.predict(step)
        across = _Across(system, predicted, direction, scale, step, control, settler)
        candidate, close = across.settled()
        if candidate.outcome is Outcome.CONVERGED:
            smooth = turn(candidate, direction, scale) > control.sharpest_turn
            passed = settler.overlooks(candidate.point, scale, step)
            passed |= _turned_twice(candidate, past.predict(0.0), direction)
            passed |= (
                settler.changed and candidate.orientation == -past.orientation != 0
            )
            seen = not passed or step <= control.narrowest
            if (close and smooth and seen) or step <= control.smallest:
                settler.keep(step)
                past.orientation = candidate.orientation
                candidate.linearised.forget()
                if not smooth:
                    candidate = _away(candidate, past.predict(0.0), scale, step)
                return candidate, step
        elif step <= control.smallest:
            where = float(past.predict(0.0)[-1])
            raise lost("the curve does not go on", where, candidate, control)
        else:
            failures += 1
        settler.retreat(failures)
        if step < 0.1 * control.largest:
            past.order = 1
        step = max(step * 0.5, control.smallest)


@dataclass(frozen=True, slots=True)
class _Across:
    """The plane across a prediction, in which a point is sought and settled."""

    system: System
    predicted: Array
    direction: Array
    scale: Array
    step: float
    control: StepControl
    settler: Settler

    def settled(self) -> tuple[Correction, bool]:
        """Return a point, settled if it is close to the prediction, and whether.

        If settling moves it far away, to another branch perhaps, and the system that
        this has made finer has a point close to the prediction, that one is taken.
        """
        candidate, close = self._found(self.predicted)
        if not close:
            return _directed(candidate, self.direction, self.scale), False
        settled = self._kept(candidate)
        far = max(0.5 * self.step, self.control.shift)
        if self._away(settled, self.predicted) > far:
            again, close = self._found(self.predicted)
            settled = self._kept(again) if close else settled
        return self._straight(settled)

    def _straight(self, settled: Correction) -> tuple[Correction, bool]:
        """Return a point whose tangent more harmonics have too, and whether it is one.

        Before a corner, and with the shortest steps that matter, it is what it is.
        """
        while settled.tangent is not None and self.step > self.control.narrowest:
            guess = self.settler.straightened(settled, self.scale)
            if guess is None:
                break
            again, close = self._found(guess)
            settled = self._kept(again) if close else settled
            if not close or turn(settled, self.direction, self.scale) < ASKEW:
                return settled, False
        return settled, True

    def _found(self, guess: Array) -> tuple[Correction, bool]:
        """Return a point in the plane through a guess, and whether it is near that."""
        candidate = correct(
            self.system,
            guess,
            self._normal,
            tolerance=self.control.tolerance,
            small=self._small,
        )
        slack = self.control.shift if self.settler.changed else self.control.slack
        near = self._away(candidate, guess) <= max(0.5 * self.step, slack)
        return candidate, near and candidate.outcome is Outcome.CONVERGED

    def _kept(self, candidate: Correction) -> Correction:
        settled = self.settler.settle(
            candidate, self._normal, self.control.tolerance, self._small
        )
        return _directed(settled, self.direction, self.scale)

    def _away(self, candidate: Correction, guess: Array) -> float:
        return distance(candidate.point, guess, self.scale)

    @property
    def _normal(self) -> Array:
        return plane_across(self.direction, self.scale)

    @property
    def _small(self) -> Small | None:
        return neglected(self.control, lambda _: self.scale)


def _directed(candidate: Correction, direction: Array, scale: Array) -> Correction:
    """Return a converged point with its tangent; failed, if it has none."""
    if candidate.outcome is not Outcome.CONVERGED:
        return candidate
    try:
        turned = tangent(candidate.linearised, direction, scale)
    except SingularError:
        return replace(candidate, outcome=Outcome.SINGULAR)
    sign = candidate.linearised.orientation(turned)
    return replace(candidate, tangent=turned, orientation=sign)


def _away(candidate: Correction, start: Array, scale: Array, step: float) -> Correction:
    """Return a point that turns sharply, headed away from ``start`` if that is far.

    What a far shorter step has thrown beyond a corner, in the plane across it, lies on
    the curve's other side, which may lead away against what continuity would have.
    """
    moved = (candidate.point - start) / scale
    far = float(np.linalg.norm(moved)) > THROWN * step
    if far and float(moved @ (candidate.along / scale)) < 0.0:
        return replace(candidate, tangent=-candidate.along)
    return candidate


def _turned_twice(candidate: Correction, start: Array, direction: Array) -> bool:
    """Return whether two folds lie between two points.

    The parameter goes back between them, though both tangents lead it the same way.
    """
    changed = float(candidate.point[-1] - start[-1]) * float(direction[-1])
    return changed < 0.0 < float(candidate.along[-1] * direction[-1])

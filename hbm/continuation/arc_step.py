"""One step of pseudo-arc-length continuation: predict, correct, settle (§6.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hbm.continuation.arc import distance, plane_across, tangent, turn
from hbm.continuation.corrected import lost, neglected
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.lifted import lifted
from hbm.continuation.linearised import SingularError, System
from hbm.continuation.newton import Small, correct
from hbm.continuation.predictor import Predictor
from hbm.continuation.settler import Settler
from hbm.continuation.step_control import StepControl
from microslip_mechanics.arrays import Array

NEAR = 0.5
"""of a step, by which a correction may leave the prediction"""
ELSEWHERE = 0.5
"""distance from the prediction at which a settled point is on another branch"""
SHORT = 0.1
"""of the longest step: where a shorter one fails, earlier points mislead"""
ASKEW = 0.7
"""cosine between the tangents of a step to a point with more harmonics, by which the
curve turns where fewer have just begun to mislead; one that turns more is at a corner
"""
NEARER = 0.75
"""times as far from its prediction is where half a step leads, if a shorter step is to
leave the other branch"""
THROWN = 10.0
"""times its length by which a step moves a point that it throws beyond a corner"""


def next_point(
    system: System,
    past: Predictor,
    step: float,
    control: StepControl,
    settler: Settler,
) -> tuple[Correction, float]:
    """Return the next point and the step that led to it, ``step`` or a shorter one.

    Raises
    ------
    ContinuationError
        If the shortest step does not converge either.
    """
    failures, strayed = 0, math.inf
    while True:
        across = _Across(system, past, step, control, settler)
        candidate, close, strayed = across.settled(strayed)
        if candidate.outcome is Outcome.CONVERGED:
            smooth = turn(candidate, past.tangent, past.scale) > control.sharpest_turn
            overlooked = settler.overlooks(candidate.point, past.scale, step)
            overlooked |= _turned_twice(past, candidate)
            overlooked |= _branched(past, candidate)
            seen = not overlooked or step <= control.narrowest
            if (close and smooth and seen) or step <= control.smallest:
                settler.keep(step)
                past.orientation = candidate.orientation
                candidate.linearised.forget()
                if not smooth:
                    candidate = _away(past, candidate, step)
                return candidate, step
        elif step <= control.smallest:
            where = float(past.point[-1])
            raise lost("the curve does not go on", where, candidate, control)
        else:
            failures += 1
        if lifted(system, past, control, settler):
            strayed = math.inf
            continue
        settler.retreat(failures)
        if step < SHORT * control.largest:
            past.order = 1
        step = max(step * 0.5, control.smallest)


@dataclass(frozen=True, slots=True)
class _Across:
    """The plane across a prediction, in which a point is sought and settled."""

    system: System
    past: Predictor
    step: float
    control: StepControl
    settler: Settler

    def settled(self, strayed: float) -> tuple[Correction, bool, float]:
        """Return a point, settled if it is close to the prediction, and whether.

        If settling moves it far away, to another branch perhaps, the point close to the
        prediction that the system has now that it is finer is taken. If there is none,
        and the branch is another one for certain, the step is too long, unless half of
        it was no better: the last of what is returned is how far such a step has
        ``strayed``, which is that of the step before.
        """
        predicted, scale = self.past.predict(self.step), self.past.scale
        candidate, close = self._found(predicted)
        if not close:
            return self._directed(candidate), False, strayed
        settled = self._kept(candidate)
        far = max(NEAR * self.step, self.control.shift)
        if distance(settled.point, predicted, scale) > far:
            again, close = self._found(predicted)
            settled = self._kept(again) if close else settled
            away = distance(settled.point, predicted, scale)
            elsewhere = ELSEWHERE < away < NEARER * strayed
            if elsewhere and self.step > self.control.narrowest:
                return settled, False, away
        return *self._straight(settled), strayed

    def _straight(self, settled: Correction) -> tuple[Correction, bool]:
        """Return a point whose tangent more harmonics have too, and whether it is one.

        Before a corner, and with the shortest steps that matter, it is what it is.
        """
        while settled.tangent is not None and self.step > self.control.narrowest:
            guess = self.settler.straightened(settled, self.past.scale)
            if guess is None:
                break
            again, close = self._found(guess)
            settled = self._kept(again) if close else settled
            along = turn(settled, self.past.tangent, self.past.scale)
            if not close or along < ASKEW:
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
        away = distance(candidate.point, guess, self.past.scale)
        near = away <= max(NEAR * self.step, slack)
        return candidate, near and candidate.outcome is Outcome.CONVERGED

    def _kept(self, candidate: Correction) -> Correction:
        settled = self.settler.settle(
            candidate, self._normal, self.control.tolerance, self._small
        )
        return self._directed(settled)

    def _directed(self, candidate: Correction) -> Correction:
        """Return a converged point with its tangent; failed, if it has none."""
        if candidate.outcome is not Outcome.CONVERGED:
            return candidate
        past = self.past
        try:
            turned = tangent(candidate.linearised, past.tangent, past.scale)
        except SingularError:
            return replace(candidate, outcome=Outcome.SINGULAR)
        sign = candidate.linearised.orientation(turned)
        return replace(candidate, tangent=turned, orientation=sign)

    @property
    def _normal(self) -> Array:
        return plane_across(self.past.tangent, self.past.scale)

    @property
    def _small(self) -> Small | None:
        return neglected(self.control, lambda _: self.past.scale)


def _turned_twice(past: Predictor, candidate: Correction) -> bool:
    """Return whether two folds lie between two points.

    The parameter goes back between them, though both tangents lead it the same way.
    """
    onwards = float(past.tangent[-1])
    changed = float(candidate.point[-1] - past.point[-1]) * onwards
    return changed < 0.0 < float(candidate.along[-1] * onwards)


def _branched(past: Predictor, candidate: Correction) -> bool:
    """Return whether the orientation tells of a branch point between two points."""
    return candidate.orientation == -past.orientation != 0.0


def _away(past: Predictor, candidate: Correction, step: float) -> Correction:
    """Return a point that turns sharply, headed away from the last if that is far.

    What a far shorter step has thrown beyond a corner, in the plane across it, lies on
    the curve's other side, which may lead away against what continuity would have.
    """
    moved = (candidate.point - past.point) / past.scale
    far = float(np.linalg.norm(moved)) > THROWN * step
    if far and float(moved @ (candidate.along / past.scale)) < 0.0:
        return replace(candidate, tangent=-candidate.along)
    return candidate

"""The hypotheses about what was sent that are fitted to a photo's stripes."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.evidence.other_codes import nearest_other
from occ_model.photo.fit.best_timing import Explanation, explain
from occ_model.photo.fit.camera_response import CameraTone
from occ_model.photo.fit.least_squares import StripeFit, Tone
from occ_model.photo.fit.read_pattern import MOST_CHIPS, read_patterns
from occ_model.photo.fitted_scene import with_chips
from occ_model.results import Stripes
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips

_NEAR = np.arange(-4, 5) / 8.0
"""Shifts of the last chip, in chips, of the steps that are tried near a known step."""


@dataclass(frozen=True, eq=False, slots=True)
class Candidates:
    """Fits hypotheses to stripes.

    Parameters
    ----------
    stripes
        The stripes to be explained.
    scene
        What is known of them.
    cameras
        The camera responses that are tried.
    fit_gamma
        Whether gamma is fitted too.
    chosen
        Function that chooses the reported fit of an explanation.
    check
        Called every few hundredths of a second; what it raises ends the fitting.
    """

    stripes: Stripes
    scene: Scene
    cameras: list[CameraTone]
    fit_gamma: bool
    chosen: Callable[[Explanation], StripeFit]
    check: Callable[[], object]

    def as_sent(self) -> Hypothesis | None:
        """Suppose what the scene sends; None where that never changes."""
        chips = sent_chips(self.scene.transmitter)
        return self._fitted("what the scene sends", chips, bits=0.0, was_read=False)

    def read(self) -> list[Hypothesis]:
        """Suppose the chips that are read from the stripes, in each way of reading them."""
        period = self.stripes.period
        if period is None:
            return []
        stripes = self.stripes
        read = read_patterns(stripes.profile, stripes.flattened, period, self.check)
        found = [
            self._fitted(
                f"{self._named(one.chips)} read from the photo",
                one.chips,
                self._near(len(one.chips) / period),
                bits=len(one.chips) + np.log2(MOST_CHIPS),
                was_read=True,
            )
            for one in read
        ]
        return [one for one in found if one is not None]

    def nearest_other(self, found: Hypothesis) -> Hypothesis | None:
        """Suppose the other chips that explain the stripes best at the timing of a hypothesis."""
        chips = nearest_other(self.stripes.profile, found, self.scene.transmitter)
        if chips is None:
            return None
        steps = self._near(found.fit.timing.step)
        bits = max(found.bits, float(self.scene.transmitter.bits))
        return self._fitted(f"{self._named(chips)} instead", chips, steps, bits=bits, was_read=True)

    def _checked(self, tone: Tone) -> Tone:
        """Check too whenever a fit evaluates the camera's response."""

        def checked(lit: FloatArray, gamma: float) -> FloatArray:
            self.check()
            return tone(lit, gamma)

        return checked

    def _near(self, step: float) -> FloatArray:
        return step + _NEAR / len(self.stripes.profile)

    def _named(self, chips: ByteArray) -> str:
        """Name chips by their code where they are a packet, else by their number."""
        scene, _ = with_chips(self.scene, chips)
        return f"{len(chips)} chips" if scene.transmitter.pattern else f"the code {_code(scene)}"

    def _fitted(
        self,
        sent: str,
        chips: ByteArray,
        steps: FloatArray | None = None,
        *,
        bits: float,
        was_read: bool,
    ) -> Hypothesis | None:
        cameras = [replace(camera, tone=self._checked(camera.tone)) for camera in self.cameras]
        gamma = self.scene.camera.gamma
        found = explain(
            self.stripes, chips, cameras, gamma, self.fit_gamma, steps, check=self.check
        )
        if found is None:
            return None
        return Hypothesis(sent, found, self.chosen(found), bits, was_read)


def _code(scene: Scene) -> str:
    return f"{scene.transmitter.code:0{scene.transmitter.bits}b}"

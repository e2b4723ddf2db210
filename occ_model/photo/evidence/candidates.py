"""The hypotheses about what was sent that are fitted to a photo's stripes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.evidence.doubts import LEAST_INFORMATION
from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.evidence.other_codes import nearest_other
from occ_model.photo.fit.best_timing import (
    CLIPPED_FRACTION,
    EXPLAINED_CORRELATION,
    Explanation,
    explain,
    explain_from,
)
from occ_model.photo.fit.camera_response import CameraResponse
from occ_model.photo.fit.chip_runs import canonical, is_single_pulse
from occ_model.photo.fit.chips_of_harmonics import ReadPattern
from occ_model.photo.fit.read_pattern import MOST_CHIPS, read_otherwise, read_patterns
from occ_model.photo.fitted_scene import exposure_time
from occ_model.photo.photo_scene import with_chips
from occ_model.results.match import Stripes
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.transmitter.scheme import sent_chips

_STEP_CHANGES = np.arange(-4, 5) / 8.0  # changes of a known step, in chips at the last column
_MOST_CORRECTIONS = 6  # maximum number of times that the chips read are replaced by similar ones
_MOST_POWER_RATIO = 0.9  # ratio of squared residuals below which similar chips replace those read


@dataclass(frozen=True, eq=False, slots=True)
class Candidates:
    """The hypotheses about one photo's stripes, which are fitted when they are asked for."""

    stripes: Stripes
    scene: Scene
    cameras: list[CameraResponse]
    fit_gamma: bool
    estimate: str  # the unknown one of readout time and switching frequency
    # The exposure time in seconds that the camera noted, None if it did not. Of fits that are
    # equally good the nearest to it is reported.
    noted: float | None
    # Called every few hundredths of a second; what it raises ends the fitting.
    check: Callable[[], object]

    def as_sent(self) -> Hypothesis | None:
        """Fit what the scene sends; None if that never changes, or has no possible fit."""
        chips = sent_chips(self.scene.transmitter)
        period = self.stripes.period
        near = [] if period is None else [self._steps_near(len(canonical(chips)) / period)]
        return self._fit("what the scene sends", chips, [*near, None], bits=0.0, was_read=False)

    def read(self, as_sent: Hypothesis | None = None) -> list[Hypothesis]:
        """Fit the chips that are read in each way, but not those that are well explained as sent.

        ``as_sent``: the fit of what the scene sends. Nothing is read if that is sure.
        """
        period = self.stripes.period
        if period is None:
            return []
        stripes = self.stripes
        explained = as_sent is not None and as_sent.fit.correlation >= EXPLAINED_CORRELATION
        if explained and as_sent is not None and as_sent.information >= LEAST_INFORMATION[True]:
            return []
        read = read_patterns(
            stripes.profile, stripes.flattened, period, self.check,
            is_clipped=stripes.saturated > CLIPPED_FRACTION,
        )  # fmt: skip
        if explained and as_sent is not None:
            known = canonical(as_sent.chips)
            read = [one for one in read if not np.array_equal(canonical(one.chips), known)]
        found = self._fit_read(read)
        best = max((one.fit.correlation for one in found), default=0.0)
        if not explained and best < EXPLAINED_CORRELATION:
            again = read_otherwise(stripes.profile, period, read, self.check)
            found += [replace(one, read_again=True) for one in self._fit_read(again)]
        return found

    def _fit_read(self, read: Sequence[ReadPattern]) -> list[Hypothesis]:
        assert self.stripes.period is not None  # noqa: S101 - else nothing is read
        found = [
            self._fit(
                f"{self._name(one.chips)} read from the photo",
                one.chips,
                [self._steps_near(one.times * len(one.chips) / self.stripes.period)],
                bits=len(one.chips) + np.log2(MOST_CHIPS),
                was_read=True,
            )
            for one in read
        ]
        return [one for one in found if one is not None]

    def correct(self, found: Hypothesis) -> tuple[Hypothesis, list[Hypothesis]]:
        """Replace chips that were read by the nearest other ones while these explain more.

        Chips are read as if white pixels were as bright as the light; if they are not, the fit may
        determine a few chips better. The best hypothesis is returned, and those compared with it.
        """
        others: list[Hypothesis] = []
        for _ in range(_MOST_CORRECTIONS):
            other = self.nearest_other(found)
            if other is None:
                return found, others
            is_better = other.fit.residual < _MOST_POWER_RATIO * found.fit.residual
            if not found.was_read or is_single_pulse(other.chips) or not is_better:
                return found, [*others, other]
            others.append(found)
            sent = f"{self._name(other.chips)} read from the photo"
            found = replace(other, sent=sent, read_again=found.read_again)
        return found, others

    def nearest_other(self, found: Hypothesis) -> Hypothesis | None:
        """Fit the other chips that explain the stripes best at the timing of a hypothesis."""
        chips = nearest_other(self.stripes.profile, found, self.scene.transmitter)
        if chips is None:
            return None
        bits = max(found.bits, float(self.scene.transmitter.bits))
        # The chips differ so little that their best timing is near, and need not be searched for.
        other = explain_from(
            [found.fit.timing], self.stripes, chips, self.cameras, self.fit_gamma, self.check
        )
        sent = f"{self._name(chips)} instead"
        return self._suppose(sent, other, bits=bits, was_read=True)

    def _steps_near(self, step: float) -> FloatArray:
        return step + _STEP_CHANGES / len(self.stripes.profile)

    def _name(self, chips: ByteArray) -> str:
        """Name chips by the lamp or the packet that they are, else by their number."""
        sends = with_chips(self.scene, chips)[0].transmitter
        if not sends.pattern:
            return f"the code {sends.code:0{sends.bits}b}"
        if is_single_pulse(chips):
            return f"a lamp with a duty of {PERCENT.format(float(chips.mean()), 3)}"
        return f"a code of {len(chips)} chips"

    def _fit(
        self,
        sent: str,
        chips: ByteArray,
        steps: Sequence[FloatArray | None],
        *,
        bits: float,
        was_read: bool,
    ) -> Hypothesis | None:
        gamma = self.scene.camera.gamma
        found = explain(
            self.stripes,
            chips,
            self.cameras,
            gamma,
            self.fit_gamma,
            steps,
            check=self.check,
        )
        return self._suppose(sent, found, bits=bits, was_read=was_read)

    def _suppose(
        self, sent: str, found: Explanation | None, *, bits: float, was_read: bool
    ) -> Hypothesis | None:
        if found is None:
            return None
        fit = found.nearest(lambda fit: exposure_time(fit, self.scene, self.estimate), self.noted)
        return Hypothesis(sent, found, fit, bits, was_read)

"""The hypotheses about what was sent that are fitted to a photo's stripes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.evidence.doubts import LEAST_INFORMATION
from occ_model.photo.evidence.hypothesis import CLIPPED_FRACTION, Hypothesis
from occ_model.photo.evidence.other_codes import nearest_other
from occ_model.photo.fit.best_timing import (
    EXPLAINED_CORRELATION,
    Explanation,
    explain,
    explain_from,
)
from occ_model.photo.fit.camera_response import CameraTone
from occ_model.photo.fit.chip_runs import canonical, is_single_pulse, pulse
from occ_model.photo.fit.chips_of_harmonics import ReadPattern
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.fit.read_pattern import MOST_CHIPS, read_otherwise, read_patterns
from occ_model.photo.fitted_scene import exposure_time, scale_frequency
from occ_model.photo.lamp_chips import MOST_PARTS
from occ_model.photo.photo_scene import with_chips
from occ_model.results.match import Stripes
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.transmitter.scheme import sent_chips

_STEP_CHANGES = np.arange(-4, 5) / 8.0  # changes of a known step, in chips at the last column
_MOST_CORRECTIONS = 6  # maximum number of times that the chips read are replaced by similar ones
_MOST_POWER_RATIO = 0.9  # ratio of squared residuals below which similar chips replace those read
_DUTY_STEPS = (4, 2, 1)  # successive steps, in parts of a period, of the search for a duty
_MOST_EXCHANGE_RATIO = 1.5  # maximum ratio of squared residuals after an exchange: both are rounded

_NOTE_TOLERANCE = 0.1
"""Maximum logarithm of the ratio of a noted exposure time to a pulse's duration: notes are off by 1
to 2 %, fitted exposures by up to 9 % (real photographs)."""


@dataclass(frozen=True, eq=False, slots=True)
class Candidates:
    """Fits hypotheses to stripes."""

    stripes: Stripes
    scene: Scene
    cameras: list[CameraTone]
    fit_gamma: bool
    estimate: str  # the unknown one of readout time and switching frequency
    # The exposure time that the camera noted, in seconds, None if it did not: of fits that are as
    # good the one that is nearest to it is reported.
    noted: float | None
    # Called every few hundredths of a second; what it raises ends the fitting.
    check: Callable[[], object]

    def exposed(self, fit: StripeFit, rate: float) -> float:
        """Return a fit's exposure time in seconds; ``rate``: its chips per chip of the scene."""
        return exposure_time(fit, scale_frequency(self.scene, rate), self.estimate)

    def as_sent(self) -> Hypothesis | None:
        """Fit what the scene sends; None where that never changes, or has no possible fit."""
        chips = sent_chips(self.scene.transmitter)
        period = self.stripes.period
        near = [] if period is None else [self._near(len(canonical(chips)) / period)]
        return self._fitted("what the scene sends", chips, [*near, None], bits=0.0, was_read=False)

    def read(self, as_sent: Hypothesis | None = None) -> list[Hypothesis]:
        """Fit the chips read in each way, but not those that ``as_sent`` explains well already."""
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
        found = self._fitted_read(read)
        best = max((one.fit.correlation for one in found), default=0.0)
        if not explained and best < EXPLAINED_CORRELATION:
            again = read_otherwise(stripes.profile, period, read, self.check)
            found += [replace(one, read_again=True) for one in self._fitted_read(again)]
        return found

    def _fitted_read(self, read: Sequence[ReadPattern]) -> list[Hypothesis]:
        assert self.stripes.period is not None  # noqa: S101 - else nothing is read
        found = [
            self._fitted(
                f"{self._named(one.chips)} read from the photo",
                one.chips,
                [self._near(one.times * len(one.chips) / self.stripes.period)],
                bits=len(one.chips) + np.log2(MOST_CHIPS),
                was_read=True,
            )
            for one in read
        ]
        return [one for one in found if one is not None]

    def dimmed(self, as_sent: Hypothesis | None) -> Hypothesis | None:
        """Fit the scene's single pulse with another duty, as of a lamp dimmed by its width.

        The exposure blurs both edges of a pulse equally, so that its width at half its height is
        that of the light: the duty is searched near it.
        """
        period, sent = self.stripes.period, canonical(sent_chips(self.scene.transmitter))
        if period is None or not is_single_pulse(sent):
            return None
        cameras = self.cameras if as_sent is None else [as_sent.explanation.camera]
        same = replace(self, cameras=cameras)
        found: dict[int, Hypothesis] = {}
        width = float(np.mean(self.stripes.flattened > 0.5))
        for step in _DUTY_STEPS:
            middle = min(found, key=lambda on: found[on].fit.residual) if found else None
            first = round(MOST_PARTS * width) if middle is None else middle
            for on in (first - step, first, first + step):
                fitted = same._dimmed(on, period, len(sent)) if on not in found else None
                if fitted is not None:
                    found[on] = fitted
        best = min(found.values(), key=lambda one: one.fit.residual, default=None)
        return best and same._exchanged(best, period, len(sent))

    def _exchanged(self, found: Hypothesis, period: float, chips_sent: int) -> Hypothesis:
        """Exchange a pulse and its exposure where that is nearer to what is known of them.

        The stripes of a pulse are its light averaged over the exposure, which is symmetric in
        both. The exposure nearest to the noted one is taken, or the shorter one.
        """
        other = self._swapped(found, period, chips_sent)
        if other is None or other.fit.residual > _MOST_EXCHANGE_RATIO * found.fit.residual:
            return found
        times = {one: self.exposed(one.fit, one.rate) for one in (found, other)}
        noted = self.noted
        if noted is None:
            return min(times, key=times.__getitem__)
        return min(times, key=lambda one: abs(np.log(times[one] / noted)))

    def as_noted(self, as_sent: Hypothesis) -> Hypothesis | None:
        """Exchange the scene's pulse and its exposure if the camera noted one as long."""
        period, sent = self.stripes.period, canonical(as_sent.chips)
        if period is None or self.noted is None or not is_single_pulse(sent):
            return None
        exposure = self.exposed(as_sent.fit, 1.0)
        lit = exposure / as_sent.fit.timing.exposure * sent.sum()
        off, swapped = (abs(np.log(time / self.noted)) for time in (exposure, lit))
        if not swapped <= _NOTE_TOLERANCE < off:
            return None
        other = self._swapped(as_sent, period, len(sent))
        return (
            other if other is not None and other.fit.correlation >= EXPLAINED_CORRELATION else None
        )

    def _swapped(self, found: Hypothesis, period: float, chips_sent: int) -> Hypothesis | None:
        on = round(MOST_PARTS * found.fit.timing.exposure / len(canonical(found.chips)))
        return self._dimmed(on, period, chips_sent)

    def _dimmed(self, on: int, period: float, chips_sent: int) -> Hypothesis | None:
        if not 0 < on < MOST_PARTS:
            return None
        chips = pulse(on, MOST_PARTS)
        step = [self._near(len(chips) / period)]
        sent = f"the scene's lamp with a duty of {on * 100 // MOST_PARTS} %"
        rate = len(chips) / chips_sent
        return self._fitted(sent, chips, step, bits=np.log2(MOST_PARTS), was_read=True, rate=rate)

    def corrected(self, found: Hypothesis) -> tuple[Hypothesis, list[Hypothesis]]:
        """Take the nearest other chips instead of those that were read, while they explain more.

        Chips are read as if white pixels were as bright as the light: where they are not, the fit
        may determine a few chips better. Returned are those found, and the others compared.
        """
        others: list[Hypothesis] = []
        for _ in range(_MOST_CORRECTIONS):
            other = self.nearest_other(found)
            if other is None:
                return found, others
            if not found.was_read or other.fit.residual >= _MOST_POWER_RATIO * found.fit.residual:
                return found, [*others, other]
            others.append(found)
            sent = f"{self._named(other.chips)} read from the photo"
            found = replace(other, sent=sent, read_again=found.read_again)
        return found, others

    def nearest_other(self, found: Hypothesis) -> Hypothesis | None:
        """Fit the other chips that explain the stripes best at the timing of a hypothesis."""
        chips = nearest_other(self.stripes.profile, found, self.scene.transmitter)
        if chips is None:
            return None
        bits = max(found.bits, float(self.scene.transmitter.bits))
        # They differ so little that what explains them best is near: it need not be searched.
        other = explain_from([found.fit.timing], self.stripes, chips, self.cameras, self.fit_gamma)
        sent = f"{self._named(chips)} instead"
        return self._supposed(sent, other, bits=bits, was_read=True, rate=found.rate)

    def _near(self, step: float) -> FloatArray:
        return step + _STEP_CHANGES / len(self.stripes.profile)

    def _named(self, chips: ByteArray) -> str:
        """Name chips by the lamp or the packet that they are, else by their number."""
        sends = with_chips(self.scene, chips)[0].transmitter
        if not sends.pattern:
            return f"the code {sends.code:0{sends.bits}b}"
        if is_single_pulse(chips):
            return f"a lamp with a duty of {PERCENT.format(float(chips.mean()), 3)}"
        return f"a code of {len(chips)} chips"

    def _fitted(
        self,
        sent: str,
        chips: ByteArray,
        steps: Sequence[FloatArray | None],
        *,
        bits: float,
        was_read: bool,
        rate: float = 1.0,
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
        return self._supposed(sent, found, bits=bits, was_read=was_read, rate=rate)

    def _supposed(
        self, sent: str, found: Explanation | None, *, bits: float, was_read: bool, rate: float
    ) -> Hypothesis | None:
        if found is None:
            return None
        fit = found.nearest(lambda fit: self.exposed(fit, rate), self.noted)
        return Hypothesis(sent, found, fit, bits, was_read, rate)

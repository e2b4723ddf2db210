"""Join frames: find the place of each in the period, and add up their likelihoods of each chip.

The place of a frame follows from a header in view, from the chips that earlier frames have shown,
from the clock, or from all of these together. Each place has a likelihood, and a frame is placed if
one place is far more likely than all others together. Since what is sent repeats, the
log-likelihood ratios of a chip in several frames add up.
"""

import numpy as np

from occ_model.arrays import BoolArray, FloatArray
from occ_model.results.video_reading import FrameReading
from occ_model.video.period import SentPeriod

_MAX_FRAME_RATIO = 8.0
"""Largest log-likelihood ratio of a chip from one frame, because a frame may be misplaced."""

_FIXED_CHIP_RATIO = 30.0  # log-likelihood ratio of a chip that is the same in every packet

_KNOWN_CHIP_RATIO = 2.0  # minimum for a chip to count as known when places are compared
_MIN_LOG_ODDS = 7.0  # minimum log-odds of the best place against all others together

_CONTRADICTING_LOG_LIKELIHOOD = -12.0  # below this a place contradicts the known chips
_MIN_DEVIATION = 0.15  # minimum standard deviation of a place predicted by the clock, in chips


class JoinedChips:
    """The chips of one period, joined from frames."""

    def __init__(self, period: SentPeriod) -> None:
        self._period = period
        self._votes = np.zeros(period.length)
        self._views = np.zeros(period.length, dtype=np.int64)
        scheme = period.scheme
        self._fraction = 1.0 if scheme is None else float(1 / scheme.line_code.chips_a_bit)

    @property
    def ratios(self) -> FloatArray:
        """Log-likelihood ratio of each chip, 0 if nothing is known, shape (length,)."""
        return self._votes + _FIXED_CHIP_RATIO * self._period.known

    @property
    def seen(self) -> BoolArray:
        """The chips that at least one frame shows whole."""
        return np.asarray(self._views > 0)

    @property
    def known(self) -> BoolArray:
        """The chips that a frame shows, or that are the same in every packet."""
        return np.asarray(self.seen | (self._period.known != 0))

    def place(
        self,
        frame: FrameReading,
        predicted: float | None = None,
        deviation: float = 0.0,
        part_unknown: bool = False,
    ) -> int | None:
        """Find the place of a frame's first chip; None if none is far more likely than the others.

        ``predicted`` and ``deviation``: the place by the clock and its standard deviation, in
        chips. ``part_unknown``: whether places are known only up to a whole number of parts.
        """
        length = self._period.length
        first, last = frame.whole
        if last <= first:
            return None
        likelihood = likelihood_by_chips = self._likelihood(frame)
        if predicted is not None:
            offsets = np.mod(np.arange(length) - predicted + 0.5 * length, length) - 0.5 * length
            likelihood = likelihood - 0.5 * (offsets / max(deviation, _MIN_DEVIATION)) ** 2
        header_places = self._period.places(frame.chips[first:last])
        places = np.array([(place - first) % length for place in header_places], dtype=np.int64)
        if part_unknown and len(places) and self._period.parts > 1:
            parts = self._period.part_length * np.arange(self._period.parts)
            places = (places[0] + parts) % length
        if len(places) == 1:
            place = int(places[0])
            return place if likelihood_by_chips[place] > _CONTRADICTING_LOG_LIKELIHOOD else None
        if len(places):
            restricted = np.full(length, -np.inf)
            restricted[places] = likelihood[places]
            likelihood = restricted
        best = int(likelihood.argmax())
        if (
            likelihood_by_chips[best] < _CONTRADICTING_LOG_LIKELIHOOD
            or _log_odds(likelihood, best) < _MIN_LOG_ODDS
        ):
            return None
        return best

    def add(self, frame: FrameReading, place: int) -> None:
        length = self._period.length
        ratios = np.clip(frame.ratios.astype(np.float64), -_MAX_FRAME_RATIO, _MAX_FRAME_RATIO)
        chip_indices = (place + np.arange(len(ratios))) % length
        np.add.at(self._votes, chip_indices, ratios)
        np.add.at(self._views, chip_indices[slice(*frame.whole)], 1)

    def rotate(self, shift: int) -> None:
        """Move all chips by ``shift`` places."""
        self._votes, self._views = np.roll(self._votes, shift), np.roll(self._views, shift)

    def _likelihood(self, frame: FrameReading) -> FloatArray:
        """Return the log-likelihood of each place, 0 without any information."""
        ratios, length = self.ratios, self._period.length
        lit, dark = (
            (ratios > _KNOWN_CHIP_RATIO).astype(np.float64),
            (ratios < -_KNOWN_CHIP_RATIO).astype(np.float64),
        )
        certainty = np.tanh(
            0.5 * np.clip(frame.ratios.astype(np.float64), -_MAX_FRAME_RATIO, _MAX_FRAME_RATIO)
        )
        log_likelihoods = np.zeros((2, length))
        chip_indices = np.arange(len(certainty)) % length
        for row, agreement in enumerate((np.log1p(certainty), np.log1p(-certainty))):
            # Chips of a line code depend on each other, so agreement counts by bits only.
            terms = np.where(agreement > 0.0, self._fraction * agreement, agreement)
            np.add.at(log_likelihoods[row], chip_indices, terms)
        spectrum = np.fft.rfft(lit) * np.conj(np.fft.rfft(log_likelihoods[0]))
        spectrum += np.fft.rfft(dark) * np.conj(np.fft.rfft(log_likelihoods[1]))
        return np.asarray(np.fft.irfft(spectrum, length))


def _log_odds(likelihood: FloatArray, place: int) -> float:
    """Return the log-odds of a place against all others together."""
    others = np.delete(likelihood, place)
    if not others.size:
        return np.inf
    largest = float(others.max())
    return float(likelihood[place]) - largest - float(np.log(np.exp(others - largest).sum()))

"""Choose among hypotheses by likelihood, with the confidence in the choice, or why none holds."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import MatchError, distinct_texts
from occ_model.photo.evidence.doubts import doubts, exposure_doubts
from occ_model.photo.evidence.hypothesis import Hypothesis, log_likelihood
from occ_model.photo.fit.chip_runs import is_single_pulse
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.envelope import remove_trend
from occ_model.photo.stripes.period import correlated_columns, harmonics_within, remove_repetition
from occ_model.results.decoding import Region
from occ_model.results.match import PLAIN_STRIPES, Stripes

_DECISIVE_LOG_LIKELIHOOD = 10.0  # difference of log-likelihoods that decides: a factor of 22,000
_MODEL_ERROR = 0.02  # error of every explanation's model, relative to the stripes' height
_COSINES_PER_CHIP = 2.0  # maximum number of cosines of a smooth curve per chip in view

_LEAST_CORRELATION_GIVEN, _LEAST_CORRELATION_READ = 0.8, 0.9  # of chips given and read

_LEAST_CORRELATION_OF_OBJECTS = 0.975
"""Minimum correlation of chips that were read where no lamp is known to blink: some chips explain
the stripes of any regular object about as well."""

_LEAST_INFORMATION = 30.0  # minimum bits: the best of many timings has 15 to 20 in any picture
_LEAST_ROW_CORRELATION = 0.7  # minimum correlation between the stripes of different rows

_BANDS = 8  # number of bands of rows that are compared


@dataclass(frozen=True, eq=False, slots=True)
class Verdict:
    """How sure a hypothesis is, and how likely the others are beside it."""

    reasons: tuple[str, ...]  # why it is doubtful, in sentences; none where it is sure
    exposure_reasons: tuple[str, ...]  # why its exposure alone is doubtful
    others: tuple[tuple[Hypothesis, float], ...]  # each, and its log-likelihood minus this one's


class Judge:
    """Compares hypotheses about the same stripes."""

    def __init__(self, stripes: Stripes, row_correlation: float, *, blinks: bool) -> None:
        self._stripes, self._row_correlation, self._blinks = stripes, row_correlation, blinks
        swing = float(np.median(stripes.high - stripes.low))
        self._error = len(stripes.profile) * (_MODEL_ERROR * swing) ** 2

    def choose(self, hypotheses: Sequence[Hypothesis]) -> Hypothesis:
        """Return the most likely hypothesis that is not refused, or raise MatchError."""
        independent = self._count_independent(hypotheses)
        likelihoods = self._likelihoods(hypotheses, independent)
        order = sorted(range(len(likelihoods)), key=lambda i: -likelihoods[i])
        reasons = [self._refusals(hypotheses[i], likelihoods[i], independent) for i in order]
        best = likelihoods[order[0]]
        for i, why in zip(order, reasons, strict=True):
            # A hypothesis that is decidedly less likely than a refused one explains nothing.
            if not why and likelihoods[i] > best - _DECISIVE_LOG_LIKELIHOOD:
                return hypotheses[i]
        # The reason that tells the user what to do comes first.
        reasons.sort(key=lambda why: PLAIN_STRIPES not in why)
        sentences = [sentence for why in reasons for sentence in why]
        raise MatchError(*dict.fromkeys(sentences))

    def verdict(
        self, found: Hypothesis, others: Sequence[Hypothesis], *, is_given: bool
    ) -> Verdict:
        """Return the confidence in a hypothesis among others.

        ``is_given``: whether what was sent is given. Another code of as many chips that is nearly
        as likely is then no reason for doubt, as it does not change the timing.
        """
        independent = self._count_independent([found, *others])
        own, *likelihoods = self._likelihoods([found, *others], independent)
        reasons = doubts(found, self._stripes, self._row_correlation)
        beside = sorted(
            zip(others, (one - own for one in likelihoods), strict=True), key=lambda pair: -pair[1]
        )
        reasons += [
            f"Nearly as likely is {other.sent}, with a correlation of {other.fit.correlation:.3f} "
            f"beside {found.fit.correlation:.3f}."
            for other, more in beside
            if more > -_DECISIVE_LOG_LIKELIHOOD
            and not (is_given and len(other.chips) == len(found.chips))
        ]
        if own - self._curve_likelihood(found, independent) < _DECISIVE_LOG_LIKELIHOOD:
            reasons.append("Light that varies slowly, without any code, is nearly as likely.")
        of_exposure = exposure_doubts(found, self._stripes)
        return Verdict(tuple(reasons), tuple(of_exposure), tuple(beside))

    def _refusals(self, found: Hypothesis, likelihood: float, independent: float) -> list[str]:
        """Return why a hypothesis is refused: something else, or chance, explains the stripes."""
        may_be_object = found.was_read and not self._blinks
        least = _LEAST_CORRELATION_READ if found.was_read else _LEAST_CORRELATION_GIVEN
        if may_be_object:
            least = _LEAST_CORRELATION_OF_OBJECTS
        if found.fit.correlation < least:
            shown, limit = distinct_texts(found.fit.correlation, least, 2)
            return [
                f"The stripes are not explained by {found.sent}: the best correlation is {shown}; "
                f"at least {limit} is needed."
            ]
        reasons = []
        if is_single_pulse(found.chips):
            fraction = 100.0 * float(found.chips.mean())
            columns = len(found.chips) / found.fit.timing.step
            reasons += [
                PLAIN_STRIPES,
                f"They repeat after {columns:.1f} columns and are bright for {fraction:.0f} % of "
                "them, as those of any regular object are, such as a blind.",
            ]
        elif may_be_object and likelihood < self._wave_likelihood(found, independent):
            reasons.append(
                "A wave of another shape that repeats as often, as of any regular object, explains "
                f"the stripes better than {found.sent}."
            )
        if found.information < _LEAST_INFORMATION:
            shown, limit = distinct_texts(max(found.information, 0.0), _LEAST_INFORMATION, 0)
            reasons.append(
                f"The stripes are better explained by {found.sent} than by chance by {shown} bits "
                f"only; at least {limit} are needed: more periods in view, a shorter exposure, or "
                "less noise give more."
            )
        if likelihood < self._curve_likelihood(found, independent):
            reasons.append(
                "Light that varies slowly, without any code, explains the stripes better than "
                f"{found.sent}."
            )
        if self._row_correlation < _LEAST_ROW_CORRELATION:
            shown, limit = distinct_texts(self._row_correlation, _LEAST_ROW_CORRELATION, 2)
            reasons.append(
                f"The rows do not show the same stripes: their correlation is {shown}; at least "
                f"{limit} is needed."
            )
        return reasons

    def _count_independent(self, hypotheses: Sequence[Hypothesis]) -> float:
        """Count the independent columns by the least residual, as larger ones contain signal."""
        best = min(hypotheses, key=lambda one: one.fit.residual)
        residual = best.residual(self._stripes.profile)
        return len(residual) / correlated_columns(residual)

    def _likelihoods(self, hypotheses: Sequence[Hypothesis], independent: float) -> list[float]:
        columns = len(self._stripes.profile)
        return [
            log_likelihood(one.fit.residual + self._error, columns, independent, one.freedom)
            - np.log(2.0) * one.bits
            for one in hypotheses
        ]

    def _wave_likelihood(self, found: Hypothesis, independent: float) -> float:
        """Return the log-likelihood of any wave of the same period, in the levels of the fit."""
        profile, columns = self._stripes.profile, len(self._stripes.profile)
        period = len(found.chips) / found.fit.timing.step
        flattened = (profile - found.fit.low) / found.fit.swing
        left = remove_repetition(flattened, period) * found.fit.swing
        # The period itself, and a cosine and a sine of each harmonic, beside the levels.
        freedom = found.freedom - 2 + 2 * harmonics_within(columns, period)
        return log_likelihood(float(left @ left) + self._error, columns, independent, freedom)

    def _curve_likelihood(self, found: Hypothesis, independent: float) -> float:
        """Return the log-likelihood of a smooth curve: of the best number of slowest cosines.

        The chips of a hypothesis limit that number, as faster cosines are stripes.
        """
        # Imported only when a photo is matched: it is slow.
        from scipy.fft import dct

        profile, columns = self._stripes.profile, len(self._stripes.profile)
        most = min(int(_COSINES_PER_CHIP * found.chips_in_view), columns // 2)
        about = profile - profile.mean()
        whole = float(about @ about)
        explained = np.cumsum(dct(about, norm="ortho") ** 2)[: max(2, most)]
        left = np.maximum(whole - explained, 1e-9 * max(whole, 1e-9))
        return max(
            log_likelihood(power + self._error, columns, independent, number + 1)
            for number, power in enumerate(left.tolist(), 1)
        )


def correlate_rows(photo: Photo, region: Region) -> float:
    """Return the median, over bands of rows, of the correlation of a band with the other ones.

    A rolling shutter's stripes are the same in all rows but for noise; those of objects differ if
    the objects are tilted, end or are broken. Slow changes along the columns are removed, as the
    shape of the lamp differs between the rows. The result is from -1 to 1, and 1 for one row.
    """
    part = region.crop(photo.samples)
    bands = min(_BANDS, len(part))
    if bands < 2:
        return 1.0
    means = cv2.resize(part, (part.shape[1], bands), interpolation=cv2.INTER_AREA)
    even = np.array([remove_trend(band) for band in means.astype(np.float64)])
    return float(np.median([_correlation(even, band) for band in range(bands)]))


def _correlation(even: FloatArray, band: int) -> float:
    others = np.delete(even, band, axis=0).mean(axis=0)
    energy = float(np.sqrt((even[band] ** 2).sum() * (others**2).sum()))
    return float(even[band] @ others) / energy if energy > 0.0 else 0.0

"""Choose among hypotheses by their likelihood, and say how sure the choice is."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.errors import MatchError
from occ_model.photo.evidence.doubts import doubts, exposure_doubts
from occ_model.photo.evidence.hypothesis import Hypothesis, independent_columns, log_likelihood
from occ_model.photo.evidence.refusal import refusals
from occ_model.photo.evidence.without_code import likelihood_of_curve, likelihood_of_wave
from occ_model.results.match import PLAIN_STRIPES, Stripes

_DECISIVE = 10.0  # difference of log-likelihoods that decides: a factor of 22,000
_MODEL_ERROR = 0.02  # error in heights of the stripes that every explanation may have
_COSINES_PER_CHIP = 2.0  # maximum number of cosines of a smooth curve per chip in view


@dataclass(frozen=True, eq=False, slots=True)
class Verdict:
    """The hypothesis that was chosen."""

    found: Hypothesis
    reasons: tuple[str, ...]  # why it is doubtful, in sentences; none where it is sure
    exposure_reasons: tuple[str, ...]  # why its exposure alone is doubtful
    others: tuple[tuple[Hypothesis, float], ...]


class Judge:
    """Compares hypotheses about the same stripes."""

    def __init__(self, stripes: Stripes, rows_alike: float, *, blinks: bool) -> None:
        self._stripes, self._rows_alike, self._blinks = stripes, rows_alike, blinks
        swing = float(np.median(stripes.high - stripes.low))
        self._error = len(stripes.profile) * (_MODEL_ERROR * swing) ** 2

    def choose(self, hypotheses: Sequence[Hypothesis]) -> Hypothesis:
        """Choose the likeliest hypothesis."""
        likelihoods = self._likelihoods(hypotheses)
        order = sorted(range(len(likelihoods)), key=lambda i: -likelihoods[i])
        reasons = [self._refusals(hypotheses[i], likelihoods[i], hypotheses) for i in order]
        best = likelihoods[order[0]]
        for i, why in zip(order, reasons, strict=True):
            # What holds but is decidedly less likely than what was refused explains nothing.
            if not why and likelihoods[i] > best - _DECISIVE:
                return hypotheses[i]
        # What a user can do about it stands first, with what it rests on.
        reasons.sort(key=lambda why: PLAIN_STRIPES not in why)
        sentences = [sentence for why in reasons for sentence in why]
        raise MatchError(*dict.fromkeys(sentences))

    def verdict(
        self, found: Hypothesis, others: Sequence[Hypothesis], *, is_given: bool
    ) -> Verdict:
        """Say how sure a hypothesis is beside others.

        ``is_given``: whether it is given what was sent: as many other chips then change no timing.
        """
        everyone = [found, *others]
        likelihoods = self._likelihoods(everyone)
        reasons = doubts(found, self._stripes, self._rows_alike)
        beside = sorted(
            zip(others, (one - likelihoods[0] for one in likelihoods[1:]), strict=True),
            key=lambda pair: -pair[1],
        )
        reasons += [
            f"Nearly as likely is {other.sent}, with a correlation of {other.fit.correlation:.3f} "
            f"beside {found.fit.correlation:.3f}."
            for other, more in beside
            if more > -_DECISIVE and not found.shares_timing_with(other, is_given=is_given)
        ]
        if likelihoods[0] - self._of_curve(found, everyone) < _DECISIVE:
            reasons.append("Light that varies slowly, without any code, is nearly as likely.")
        of_exposure = exposure_doubts(found, self._stripes)
        return Verdict(found, tuple(reasons), tuple(of_exposure), tuple(beside))

    def _refusals(
        self, found: Hypothesis, likelihood: float, everyone: Sequence[Hypothesis]
    ) -> list[str]:
        independent = self._independent(everyone)
        return refusals(
            found,
            curve=self._of_curve(found, everyone),
            wave=likelihood_of_wave(self._stripes.profile, found, independent, self._error),
            likelihood=likelihood,
            rows_alike=self._rows_alike,
            blinks=self._blinks,
        )

    def _of_curve(self, found: Hypothesis, everyone: Sequence[Hypothesis]) -> float:
        most = int(_COSINES_PER_CHIP * found.counted_chips)
        independent = self._independent(everyone)
        return likelihood_of_curve(self._stripes.profile, most, independent, self._error)

    def _likelihoods(self, hypotheses: Sequence[Hypothesis]) -> list[float]:
        independent, profile = self._independent(hypotheses), self._stripes.profile
        return [
            log_likelihood(one.fit.residual + self._error, len(profile), independent, one.freedom)
            - np.log(2.0) * one.bits
            for one in hypotheses
        ]

    def _independent(self, hypotheses: Sequence[Hypothesis]) -> float:
        """Count the independent columns by the least residual: what is left of others is signal."""
        best = min(hypotheses, key=lambda one: one.fit.residual)
        return independent_columns(best.residual(self._stripes.profile))

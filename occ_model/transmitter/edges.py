"""The light of an LED that takes time to switch, and its exact running integral.

The chips s(x), x in chips, are averaged over the last ``tau``:
s_tau(x) = (1/tau) (C(x) - C(x - tau)), with C their running integral. The light is then continuous
and piecewise linear, its own running integral piecewise quadratic.
"""

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.transmitter.waveform import Duration, Phases, Waveform

PhasesAt = Callable[[Fraction], Phases]
"""Gives the phases of all windows' starts, each moved by so many chips."""


class EdgedWaveform:
    """The light of a chip sequence sent over and over by an LED with edges.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        One period.
    edge
        The edge time tau in chips, above 0.
    """

    def __init__(self, chips: ByteArray, edge: Fraction) -> None:
        self.period = len(chips)
        self._sharp = Waveform(chips)
        self._level: FloatArray = chips.astype(np.float64)
        self._edge = edge

    def lit_chips(self, starts: PhasesAt, exposure: Fraction) -> FloatArray:
        """Light within windows, in lit chips.

        Parameters
        ----------
        starts
            Where the windows start.
        exposure
            How long they all last, in chips.

        Returns
        -------
        ndarray of float64, shape as the starts
        """
        if self._edge < 1:
            sharp = self._sharp.lit_chips(starts(Fraction(0)), Duration.of(exposure, self.period))
            kept_back = self._lag(starts(exposure)) - self._lag(starts(Fraction(0)))
            return np.asarray(sharp - kept_back)
        mean = float(self._level.mean())
        gained = self._swing_integral(starts(exposure)) - self._swing_integral(starts(Fraction(0)))
        before = self._swing_integral(starts(exposure - self._edge))
        before -= self._swing_integral(starts(-self._edge))
        return mean * float(exposure) + (gained - before) / float(self._edge)

    def _lag(self, phases: Phases) -> FloatArray:
        """Light that the ramps have kept back up to each phase, for edges within one chip.

        All ramps that are over have kept back tau/2 of each rise and given back as much of each
        fall: tau/2 times the last chip's state. On a ramp of height h it is h (x - x^2 / (2 tau))
        more. No difference of large numbers is taken, so that it holds down to tau = 0.
        """
        edge = float(self._edge)
        before = self._level[phases.chip - 1]
        rise = self._level[phases.chip] - before
        along = np.minimum(phases.fraction, edge)
        return 0.5 * edge * before + rise * along * (1.0 - 0.5 * along / edge)

    def _swing_integral(self, phases: Phases) -> FloatArray:
        """Integral, up to each phase, of the running integral of the chips less their mean.

        Both integrals are of something whose mean is taken out, so that they are periodic and stay
        small however long the edge is.
        """
        swing = self._level - self._level.mean()
        at_chip = np.concatenate([[0.0], np.cumsum(swing)[:-1]])
        # The mean of the first integral over the period: its value at each chip, and half a slope.
        at_chip -= (at_chip + 0.5 * swing).mean()
        second = np.concatenate([[0.0], np.cumsum(at_chip + 0.5 * swing)[:-1]])
        x = phases.fraction
        chip = phases.chip
        return np.asarray(second[chip] + x * (at_chip[chip] + 0.5 * x * swing[chip]))


def most_changes(chips: ByteArray, span: float) -> int:
    """Give the most changes of state within any ``span`` chips of a sequence sent over and over.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        One period.
    span
        Length of time in chips.
    """
    changes = (chips != np.roll(chips, 1)).astype(np.int64)
    periods, rest = divmod(math.ceil(span) + 1, len(chips))
    before = np.concatenate([[0], np.cumsum(np.concatenate([changes, changes]))])
    part = before[rest : rest + len(chips)] - before[: len(chips)]
    return periods * int(changes.sum()) + int(part.max())

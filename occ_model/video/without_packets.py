"""Describe a film without packets: frames that blink as a whole, bursts, or a lamp."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.errors import inflect
from occ_model.photo.stripes.envelope import remove_trend
from occ_model.photo.stripes.period import correlated_columns, repeat_period, unrepeated_fraction
from occ_model.receiver.signal import column_means
from occ_model.results.decoding import Region
from occ_model.results.video_reading import Clock, MeasuredValue
from occ_model.scene.units import HERTZ, SECOND, Unit
from occ_model.video.clock import describe_clock, fit_film_clock
from occ_model.video.frame_times import FrameTimes
from occ_model.video.phase_fit import FramePhases

_HALVES = 2  # a lamp's phase is counted in halves of its cycle, as limits in chips suit these

_MIN_PERIODS = 3.0  # minimum in a frame, because two may be equal by chance
_MAX_UNREPEATED = 0.1  # of the stripes' variance that a repeated wave may leave unexplained
_MIN_CHANGE = 0.2  # fraction of the brightest frames' light by which dark frames must differ
_MIN_SAME_FRACTION = 0.9  # fraction of equal frames from which all count as equal


@dataclass(frozen=True, slots=True)
class _FrameStripes:
    """The time and mean level of a frame, and its stripes if they repeat."""

    time: float
    level: float
    period: float = 0.0
    place: float = 0.0
    place_error: float = 0.0
    period_error: float = 0.0
    column: float = 0.0
    is_pulse: bool = False

    @property
    def repeats(self) -> bool:
        return self.period > 0.0


class WithoutPackets:
    """Analyses the frames of a film in which no packet is found."""

    def __init__(self) -> None:
        self._looks: list[_FrameStripes] = []

    def add(self, time: float, image: ByteArray, region: Region | None) -> None:
        region = region or Region(0, image.shape[0], 0, image.shape[1])
        even = remove_trend(column_means(image, region))
        self._looks.append(_analyse_frame(time, float(image.mean()), even, region.first_column))

    def fit_clock(
        self, times: FrameTimes | None, readout_time: float, tolerance: float, columns: int
    ) -> Clock | None:
        seen = [look for look in self._looks if look.is_pulse]
        if (
            times is None
            or len(times.parts) != 1
            or len(seen) < _MIN_SAME_FRACTION * len(self._looks)
        ):
            return None
        phases = FramePhases(
            times=np.array([look.time for look in seen]),
            columns=np.array([look.column for look in seen]),
            places=np.array([look.place for look in seen]),
            errors=np.array([look.place_error for look in seen]),
            steps=np.array([_HALVES / look.period for look in seen]),
            step_errors=np.array([_HALVES / look.period**2 * look.period_error for look in seen]),
            period=float(_HALVES),
        )
        fits = fit_film_clock(phases, readout_time, tolerance, columns, times.period.value)
        if not fits:
            return None
        clock = describe_clock(fits, phases, times, times.parts[0], columns, _HALVES)
        # The lamp's shape shifts the stripes of all frames equally, which causes no scatter.
        readout, shared = clock.readout_time, self._period_error(seen)
        error = math.hypot(readout.error, shared * readout.value)
        gap_error = math.hypot(clock.gap.error, columns * shared * readout.value)
        return replace(
            clock,
            readout_time=MeasuredValue(readout.value, error),
            gap=MeasuredValue(clock.gap.value, gap_error),
        )

    @staticmethod
    def _period_error(seen: Sequence[_FrameStripes]) -> float:
        """Return the relative error of a period; many frames do not reduce that of one of them."""
        return float(np.median([look.period_error / look.period for look in seen]))

    def describe(self, readout_time: float) -> str:
        """Describe what the frames show, using a rough readout time; empty if they show nothing."""
        seen = [look for look in self._looks if look.repeats]
        count = len(self._looks)
        if not seen:
            return self._describe_levels()
        pulses, what = _select_pulses(seen), "The stripes repeat"
        if pulses:
            seen, what = pulses, "A lamp is lit once in each period: its stripes repeat"
        period = float(np.median([look.period for look in seen]))
        columns = Unit("columns").format_estimate(period, period * self._period_error(seen))
        text = (
            f"{what} after {columns}, or at {HERTZ.format(1.0 / (period * readout_time), 4)} for "
            f"a readout time of {SECOND.format(readout_time)}."
        )
        if len(seen) >= _MIN_SAME_FRACTION * count:
            return text
        return f"{text} Only {len(seen)} of {count} frames show them."

    @property
    def may_be_packets(self) -> bool:
        """Whether the stripes may be those of a code: they repeat and are not a lamp's."""
        seen = [look for look in self._looks if look.repeats]
        return bool(seen) and not _select_pulses(seen)

    def _describe_levels(self) -> str:
        """Describe frames that are bright or dark as a whole."""
        levels = np.array([look.level for look in self._looks])
        low, high = (float(level) for level in np.quantile(levels, (0.1, 0.9)))
        if len(levels) < 3 or high - low < _MIN_CHANGE * high:
            return ""
        bright = levels > 0.5 * (low + high)
        changes = int(np.count_nonzero(bright[1:] != bright[:-1]))
        lasts = self._looks[-1].time - self._looks[0].time
        return (
            f"Whole frames are bright or dark: {int(bright.sum())} of {len(levels)} are bright, "
            f"and that changes {inflect(changes, 'time')} in {SECOND.format(lasts, 3)}. No frame "
            "shows stripes that repeat."
        )


def _select_pulses(seen: Sequence[_FrameStripes]) -> list[_FrameStripes]:
    """Return the frames that show a plain pulse; none if many show other stripes."""
    pulses = [look for look in seen if look.is_pulse]
    return pulses if len(pulses) >= _MIN_SAME_FRACTION * len(seen) else []


def _analyse_frame(time: float, level: float, even: FloatArray, first_column: int) -> _FrameStripes:
    """Find repeated stripes and the phase of their first harmonic in the middle."""
    columns = len(even)
    found = repeat_period(even) if columns > 2 and float(np.ptp(even)) > 0.0 else None
    if found is None or found[0] * _MIN_PERIODS > columns:
        return _FrameStripes(time, level)
    period, error = found
    left = unrepeated_fraction(even, period)
    if left > _MAX_UNREPEATED:
        return _FrameStripes(time, level)
    middle = 0.5 * (columns - 1)
    window = np.hanning(columns + 2)[1:-1]
    turned = np.exp(-2j * np.pi * (np.arange(columns) - middle) / period)
    phase = float(np.angle((window * even) @ turned))
    # For a wave mostly in its first harmonic, by the number of independent columns.
    independent = columns / correlated_columns(even)
    rising = int(np.count_nonzero((even[1:] > 0.0) & (even[:-1] <= 0.0)))
    return _FrameStripes(
        time,
        level,
        period,
        _HALVES * (phase / (2.0 * math.pi) % 1.0),
        _HALVES / (2.0 * math.pi) * math.sqrt(left / max(independent, 1.0)),
        error,
        first_column + middle,
        is_pulse=rising <= columns / period + 1.0,
    )

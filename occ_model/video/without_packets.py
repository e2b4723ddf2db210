"""Describe a film without packets: frames that blink as a whole, bursts, or a lamp."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.errors import inflect
from occ_model.photo.stripes.envelope import remove_trend
from occ_model.photo.stripes.period import correlated_columns, repeat_period, unrepeated_fraction
from occ_model.receiver.signal import column_means
from occ_model.results.clock import Clock
from occ_model.results.decoding import Region
from occ_model.scene.units import HERTZ, SECOND, Unit
from occ_model.video.blinking import fit_blinking
from occ_model.video.film_clock import FilmPhases, clock_of_lamp, describe_clock
from occ_model.video.frame_times import FrameTimes
from occ_model.video.known_timing import HALF_CYCLES, KnownTiming
from occ_model.video.phase_fit import FramePhases

_MIN_PERIODS = 3.0  # minimum in a frame, because two may be equal by chance
_MAX_UNREPEATED = 0.1  # of the stripes' variance that a repeated wave may leave unexplained
_MIN_CHANGE = 0.2  # fraction of the brightest frames' light by which dark frames must differ
_MAX_UNEQUAL = 0.5  # frame periods by which steps may differ for a frequency of the levels
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

    def __init__(self, known: KnownTiming) -> None:
        self._known = known  # in half cycles
        self._frames: list[_FrameStripes] = []

    def add(self, time: float, image: ByteArray, region: Region | None) -> None:
        region = region or Region(0, image.shape[0], 0, image.shape[1])
        levels = remove_trend(column_means(image, region))
        self._frames.append(_analyse_frame(time, float(image.mean()), levels, region.first_column))

    def fit_clock(self, times: FrameTimes | None, columns: int) -> tuple[Clock | None, str]:
        """Return the clock of a lamp, or the reason why there is none; empty if it is no lamp."""
        pulses = [(number, frame) for number, frame in enumerate(self._frames) if frame.is_pulse]
        if len(pulses) < max(_MIN_SAME_FRACTION * len(self._frames), 1):
            return None, ""
        if times is None or len(times.parts) != 1:
            return None, "the frame times do not increase, or jump."
        numbers, frames = zip(*pulses, strict=True)
        film = FilmPhases(
            _half_cycle_phases(frames), times.numbers[[*numbers]], times, self._known, columns
        )
        clocks = film.fit_clocks()
        clock = (
            describe_clock(clocks, film, times.parts[0], HALF_CYCLES)
            if clocks.fits
            else clock_of_lamp(film, clocks.reason, HALF_CYCLES)
        )
        if clock is None:
            return None, clocks.reason
        # The lamp's shape shifts the stripes of all frames equally, which causes no scatter.
        return clock.widen_readout(self._period_error(frames), columns), ""

    @staticmethod
    def _period_error(repeating: Sequence[_FrameStripes]) -> float:
        """Return the relative error of a period, which more frames do not reduce."""
        return float(np.median([frame.period_error / frame.period for frame in repeating]))

    def describe(self, readout_time: float) -> str:
        """Describe what the frames show, using a rough readout time; empty if they show nothing."""
        frames = [frame for frame in self._frames if frame.repeats]
        count = len(self._frames)
        if not frames:
            return self._describe_levels()
        pulses, what = _select_pulses(frames), "The stripes repeat"
        if pulses:
            frames, what = pulses, "A lamp is lit once in each period: its stripes repeat"
        period = float(np.median([frame.period for frame in frames]))
        columns = Unit("columns").format_estimate(period, period * self._period_error(frames))
        text = (
            f"{what} after {columns}, or at {HERTZ.format(1.0 / (period * readout_time), 4)} for "
            f"a readout time of {SECOND.format(readout_time)}."
        )
        if len(frames) >= _MIN_SAME_FRACTION * count:
            return text
        return f"{text} Only {len(frames)} of {count} frames show them."

    @property
    def may_be_packets(self) -> bool:
        """Whether the stripes may be those of a code: they repeat and are not a lamp's."""
        repeating = [frame for frame in self._frames if frame.repeats]
        return bool(repeating) and not _select_pulses(repeating)

    def _describe_levels(self) -> str:
        """Describe frames that are bright or dark as a whole."""
        levels = np.array([frame.level for frame in self._frames])
        low, high = (float(level) for level in np.quantile(levels, (0.1, 0.9)))
        if len(levels) < 3 or high - low < _MIN_CHANGE * high:
            return ""
        bright = levels > 0.5 * (low + high)
        changes = int(np.count_nonzero(bright[1:] != bright[:-1]))
        times = np.array([frame.time for frame in self._frames])
        seconds = float(np.ptp(times))
        return (
            f"Whole frames are bright or dark: {int(bright.sum())} of {len(levels)} are bright, "
            f"and that changes {inflect(changes, 'time')} in {SECOND.format(seconds, 3)}."
            f"{_describe_blinking(times, levels)} No frame shows stripes that repeat."
        )


def _describe_blinking(times: FloatArray, levels: FloatArray) -> str:
    """State the frequency of light that changes from frame to frame; empty if it is irregular."""
    steps = np.diff(times)
    if np.ptp(steps) > _MAX_UNEQUAL * float(np.median(steps)):
        return ""
    blinking = fit_blinking(times, levels)
    if blinking is None:
        return ""
    rate = 1.0 / float(np.median(steps))
    frequency = HERTZ.format_estimate(blinking.value, blinking.error)
    return (
        f" They blink at {frequency}, or at that much above or below a whole multiple of the "
        f"{HERTZ.format(rate, 4)} of the frames."
    )


def _half_cycle_phases(frames: Sequence[_FrameStripes]) -> FramePhases:
    phases = (
        (
            frame.time, frame.column, frame.place, frame.place_error, HALF_CYCLES / frame.period,
            HALF_CYCLES / frame.period**2 * frame.period_error,
        )
        for frame in frames
    )  # fmt: skip
    return FramePhases.of(phases, float(HALF_CYCLES))


def _select_pulses(frames: Sequence[_FrameStripes]) -> list[_FrameStripes]:
    """Return the frames that show a plain pulse; none if many show other stripes."""
    pulses = [frame for frame in frames if frame.is_pulse]
    return pulses if len(pulses) >= _MIN_SAME_FRACTION * len(frames) else []


def _analyse_frame(
    time: float, level: float, levels: FloatArray, first_column: int
) -> _FrameStripes:
    """Find repeated stripes and the phase of their first harmonic in the middle."""
    columns = len(levels)
    estimate = repeat_period(levels) if columns > 2 and float(np.ptp(levels)) > 0.0 else None
    if estimate is None or estimate[0] * _MIN_PERIODS > columns:
        return _FrameStripes(time, level)
    period, error = estimate
    unrepeated = unrepeated_fraction(levels, period)
    if unrepeated > _MAX_UNREPEATED:
        return _FrameStripes(time, level)
    middle = 0.5 * (columns - 1)
    window = np.hanning(columns + 2)[1:-1]
    phasors = np.exp(-2j * np.pi * (np.arange(columns) - middle) / period)
    phase = float(np.angle((window * levels) @ phasors))
    # For a wave that is mostly its first harmonic, from the number of independent columns.
    independent = columns / correlated_columns(levels)
    rising = int(np.count_nonzero((levels[1:] > 0.0) & (levels[:-1] <= 0.0)))
    return _FrameStripes(
        time,
        level,
        period,
        HALF_CYCLES * (phase / (2.0 * math.pi) % 1.0),
        HALF_CYCLES / (2.0 * math.pi) * math.sqrt(unrepeated / max(independent, 1.0)),
        error,
        first_column + middle,
        is_pulse=rising <= columns / period + 1.0,
    )

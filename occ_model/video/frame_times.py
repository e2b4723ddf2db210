"""Find the period of a film's stated frame times, and their irregularities.

A container keeps times to a resolution: Matroska whole milliseconds, GIF hundredths of a second.
Where the resolution is as long as a frame period, as in AVI, frames are counted, and the stated
period is taken as exact.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.errors import inflect
from occ_model.results.clock import MeasuredValue
from occ_model.scene.units import SECOND
from occ_model.video.frame_period import fit_line, fit_rounded_period

_MAX_INTERVAL_DEVIATION = 0.25  # maximum deviation of an interval from whole periods, in periods
_MAX_TIME_DEVIATION = 0.02  # scatter of frame times in periods from which it is reported
_MAX_NAMED_FRAMES = 3  # maximum number of frames that a sentence names

LEAST_BREAK = 16.0
"""Periods between two frames from which a new part of the film begins: the times of a stopped
camera or a damaged file have no relation to the frames before."""

_MIN_FRAMES_PER_PART = 4.0  # mean number of frames per part from which the times are meaningful
_MIN_INTERVAL = 1e-9  # seconds below which two frames have the same time
_COUNTED = 0.9  # periods from which a resolution is that of counted frames
_STEADY_SCATTER = 0.35  # resolutions up to which times from equal steps are only rounded
_ROUNDED_INTERVAL = 1.01  # resolutions by which rounding alone changes an interval


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a film, within which the times do not jump."""

    # The number of its first frame, and of the one after its last
    first: int
    end: int
    # Start of its first frame, and time to the end of its last frame's period, in seconds
    start: float
    duration: float


@dataclass(frozen=True, eq=False, slots=True)
class FrameTimes:
    period: MeasuredValue  # Frame period in seconds, with an error from scatter and resolution
    resolution: float  # In seconds; 0 if the times are exact, or count frames
    scatter: float  # Standard deviation in seconds of the times from equal steps
    # Shape (frames,): number of periods from the first frame of its part to each frame
    numbers: IndexArray
    parts: tuple[Part, ...]  # The parts of the film, between which the times jump
    problems: tuple[str, ...]

    def is_jump(self, interval: float) -> bool:
        """Return whether an interval is negative, or so long that a new part begins after it."""
        return interval > LEAST_BREAK * self.period.value or interval < -_MIN_INTERVAL

    def ends(self, part: Part) -> FloatArray:
        """Return the numbers of a part's first frame period and of the one after its last."""
        return np.array([0.0, self.numbers[part.end - 1] + 1.0])

    @property
    def are_consecutive(self) -> bool:
        """Whether most frames are consecutive, so that their times determine a clock."""
        return len(self.parts) == 1 or len(self.numbers) >= _MIN_FRAMES_PER_PART * len(self.parts)

    def part_of(self, frame: int) -> Part:
        """Return the part that contains a frame; the last one for frames added later."""
        return next((part for part in self.parts if frame < part.end), self.parts[-1])

    def elapsed(self, frame: int) -> float:
        """Return the duration of the film up to the end of a frame's period, in seconds."""
        current = self.part_of(frame)
        earlier = sum(part.duration for part in self.parts if part.end <= current.first)
        return earlier + float(self.numbers[frame] + 1) * self.period.value


def fit_frame_times(times: FloatArray, resolution: float = 0.0) -> FrameTimes | None:
    """Find the period of frame times in seconds; None if fewer than two differ.

    ``resolution``: the step in seconds to whose multiples the times were rounded.
    """
    intervals = np.diff(times)
    forward_intervals = intervals[intervals > _MIN_INTERVAL]
    if forward_intervals.size == 0:
        return None
    usual = float(np.median(forward_intervals))
    rounding = _ROUNDED_INTERVAL * resolution + _MIN_INTERVAL
    near = np.abs(forward_intervals - usual) <= rounding
    if near.any():  # the mean of what rounding alone makes of one interval
        usual = float(forward_intervals[near].mean())
    if resolution >= _COUNTED * usual:
        resolution, rounding = 0.0, _MIN_INTERVAL
    jumps = (intervals > LEAST_BREAK * usual) | (intervals < -_MIN_INTERVAL)
    is_usual = (np.abs(intervals - usual) <= rounding) & (intervals > _MIN_INTERVAL)
    if fit_line(np.arange(float(len(times))), times)[2] < _STEADY_SCATTER * resolution:
        is_usual |= True
    counts = np.where(is_usual, 1, np.rint(np.where(jumps, 0.0, intervals) / usual))
    counts = counts.astype(np.int64)
    firsts = np.concatenate([[0], np.flatnonzero(jumps) + 1])
    sizes = np.diff(np.append(firsts, len(times)))
    period_numbers = np.concatenate([[0], np.cumsum(counts)])
    numbers = period_numbers - np.repeat(period_numbers[firsts], sizes)
    period, scatter = _fit_period(times, numbers, firsts, resolution)
    steps = np.where(jumps, 1.0, np.where(is_usual, 1.0, intervals / usual))
    problems = _describe_problems(steps, counts + jumps, usual)
    if scatter > max(_MAX_TIME_DEVIATION * usual, resolution):
        problems.append(
            f"The frame times are uneven: they deviate by {SECOND.format(scatter)} from equal "
            f"steps of {SECOND.format(period.value)}."
        )
    if jumps.any():
        problems.append(_describe_jump(intervals, jumps))
    ends = (firsts + sizes).tolist()
    parts = tuple(
        Part(first, end, float(times[first]), float(numbers[end - 1] + 1) * period.value)
        for first, end in zip(firsts.tolist(), ends, strict=True)
    )
    return FrameTimes(period, resolution, scatter, numbers, parts, tuple(problems))


def _fit_period(
    times: FloatArray, numbers: IndexArray, firsts: IndexArray, resolution: float
) -> tuple[MeasuredValue, float]:
    """Return the period of parts that begin at arbitrary times, and the times' scatter."""
    sizes = np.diff(np.append(firsts, len(times)))
    steps, centred_times = (
        values - np.repeat(np.add.reduceat(values, firsts) / sizes, sizes)
        for values in (numbers.astype(np.float64), times)
    )
    power, freedom = float(steps @ steps), len(times) - len(firsts) - 1
    period = float(steps @ centred_times) / power
    residuals = centred_times - steps * period
    scatter = float(np.sqrt(residuals @ residuals / max(freedom, 1)))
    if resolution == 0.0:
        return MeasuredValue(period, scatter / float(np.sqrt(power))), scatter
    longest = int(sizes.argmax())
    part = slice(int(firsts[longest]), int(firsts[longest] + sizes[longest]))
    return fit_rounded_period(numbers[part].astype(np.float64), times[part], resolution), scatter


def _describe_jump(intervals: FloatArray, jumps: BoolArray) -> str:
    frames = np.flatnonzero(jumps)
    return (
        f"The frame times jump by {SECOND.format(float(intervals[frames[0]]))} after "
        f"{_list_frames(frames)}; what was sent in between is not counted."
    )


def _describe_problems(steps: FloatArray, counts: IndexArray, usual: float) -> list[str]:
    problems = []
    missing = np.flatnonzero(counts > 1)
    if missing.size:
        count = int((counts[missing] - 1).sum())
        frames = f"{inflect(count, 'frame')} {'is' if count == 1 else 'are'}"
        problems.append(
            f"According to the frame times {frames} missing after {_list_frames(missing)}."
        )
    backward = np.flatnonzero(steps <= 0.0)
    if backward.size:
        problems.append(
            f"The frame times do not increase after {_list_frames(backward)}: frames are doubled."
        )
    uneven = np.flatnonzero((np.abs(steps - counts) > _MAX_INTERVAL_DEVIATION) & (steps > 0.0))
    if uneven.size:
        problems.append(
            f"The frame rate is not constant: {len(uneven)} of {len(steps)} intervals are not a "
            f"whole number of {SECOND.format(usual)}, the first after {_list_frames(uneven[:1])}."
        )
    return problems


def _list_frames(frames: IndexArray) -> str:
    names = [str(frame) for frame in frames[:_MAX_NAMED_FRAMES].tolist()]
    more = f" and {len(frames) - _MAX_NAMED_FRAMES} more" if len(frames) > _MAX_NAMED_FRAMES else ""
    return ("frame " if len(frames) == 1 else "frames ") + ", ".join(names) + more

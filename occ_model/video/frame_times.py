"""The times that a film states for its frames: their period, and what is not regular in them."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.results.video_reading import Measured
from occ_model.scene.units import SECOND

_EVEN = 0.25
"""Share of a period by which an interval may differ from a whole number of them."""

_UNEVEN = 0.02
"""Standard deviation of the frame times, as a share of the period, that is told."""

_NAMED = 3
"""Most frames that a sentence names."""


@dataclass(frozen=True, eq=False, slots=True)
class FrameTimes:
    """The times of frames.

    Parameters
    ----------
    period
        The frame period in seconds; its error is that of the times' scatter.
    numbers : ndarray of int64, shape (frames,)
        How many periods each frame lies after the first one.
    problems
        Sentences.
    """

    period: Measured
    numbers: IndexArray
    problems: tuple[str, ...]


def frame_times(times: FloatArray, rounded_to: float = 0.0) -> FrameTimes | None:
    """Find the period of frame times.

    Parameters
    ----------
    times : ndarray of float64, shape (frames,)
        In seconds.
    rounded_to
        The step that they are whole multiples of, in seconds.

    Returns
    -------
    FrameTimes or None
        None where fewer than two times differ.
    """
    intervals = np.diff(times)
    ahead = intervals[intervals > 0.0]
    if ahead.size == 0:
        return None
    usual = float(np.median(ahead))
    counts = np.rint(intervals / usual).astype(np.int64)
    numbers = np.concatenate([[0], np.cumsum(counts)])
    problems = _problems(intervals / usual, counts, usual)
    if len(times) < 3:
        return FrameTimes(Measured(usual, rounded_to), numbers, tuple(problems))
    parts = np.column_stack([np.ones(len(times)), numbers - numbers.mean()])
    found = np.linalg.lstsq(parts, times, rcond=None)[0]
    residuals = times - parts @ found
    free = len(times) - 2
    scatter = max(float(residuals @ residuals) / free, rounded_to**2 / 12.0)
    error = float(np.sqrt(scatter / (parts[:, 1] @ parts[:, 1])))
    deviation = float(np.sqrt(residuals @ residuals / free))
    if deviation > max(_UNEVEN * usual, rounded_to):
        problems.append(
            f"The frame times are uneven: they deviate by {SECOND.format(deviation)} from equal "
            f"steps of {SECOND.format(float(found[1]))}."
        )
    return FrameTimes(Measured(float(found[1]), error), numbers, tuple(problems))


def _problems(steps: FloatArray, counts: IndexArray, usual: float) -> list[str]:
    problems = []
    missing = np.flatnonzero(counts > 1)
    if missing.size:
        problems.append(
            f"{_frames(int((counts[missing] - 1).sum()))} missing, as the frame times show: after "
            f"{_named(missing)}."
        )
    backward = np.flatnonzero(steps <= 0.0)
    if backward.size:
        problems.append(
            f"The frame times do not rise after {_named(backward)}: frames are doubled or out of "
            "order."
        )
    odd = np.flatnonzero((np.abs(steps - counts) > _EVEN) & (steps > 0.0))
    if odd.size:
        problems.append(
            f"The frame rate is not constant: {len(odd)} of {len(steps)} intervals are no whole "
            f"number of {SECOND.format(usual)}, the first after {_named(odd[:1])}."
        )
    return problems


def _frames(count: int) -> str:
    return "1 frame is" if count == 1 else f"{count} frames are"


def _named(frames: IndexArray) -> str:
    names = [str(frame) for frame in frames[:_NAMED].tolist()]
    more = f" and {len(frames) - _NAMED} more" if len(frames) > _NAMED else ""
    return ("frame " if len(frames) == 1 else "frames ") + ", ".join(names) + more

"""Read one frame of a film: its chips, how sure each is, and their exact timing."""

from dataclasses import dataclass, replace

import numpy as np

from occ_model.receiver.decode import decode
from occ_model.receiver.light import in_light
from occ_model.results import DecodeResult
from occ_model.results.video import VideoFrame
from occ_model.results.video_reading import FrameReading
from occ_model.scene.scene import Scene
from occ_model.video.chip_timing import ChipTiming, fit_timing
from occ_model.video.first_lattice import first_lattice

_MOST_UNEXPLAINED = 0.3
"""Share of the signal's variance that the chips leave unexplained above which they are not read."""

_EDGE = 1e-6
"""Chips of rounding that do not cut a chip off."""


@dataclass(frozen=True, eq=False, slots=True)
class TimedFrame:
    """A frame's reading and the timing of its chips.

    Parameters
    ----------
    reading
        What the frame shows.
    middle, middle_error
        Where the exposure of ``column`` has its middle, in chips from the first chip's start.
    column
        A column of the picture, the middle one of the region.
    step, step_error
        Chips from one column to the next.
    """

    reading: FrameReading
    middle: float = 0.0
    middle_error: float = 0.0
    column: float = 0.0
    step: float = 0.0
    step_error: float = 0.0

    @property
    def is_read(self) -> bool:
        """Whether it shows chips."""
        return bool(self.reading.chips.size)


def film_scene(scene: Scene) -> Scene:
    """Return what a receiver of a film knows: its pictures are the camera's, not enhanced."""
    return scene.replace(enhancement="none")


def read_frame(frame: VideoFrame, scene: Scene, decoder: str) -> TimedFrame:
    """Read the chips of a frame.

    Parameters
    ----------
    frame
        The frame.
    scene
        What the receiver knows, roughly, as :func:`film_scene` gives it.
    decoder
        The name of the decoder that finds the chips.
    """
    if frame.exposure_time is not None:
        scene = scene.replace(exposure_time=frame.exposure_time)
    result = decode(frame.image, scene, decoder)
    reading = FrameReading(frame.index, frame.time, result.region)
    lattice = first_lattice(result, scene)
    if lattice is None or result.signal is None:
        why = result.failure or "The decoder gives no chips, which joining frames needs."
        return TimedFrame(replace(reading, failure=why))
    timing = fit_timing(in_light(result.signal, scene).values, lattice)
    if timing is None or timing.unexplained > _MOST_UNEXPLAINED:
        return TimedFrame(
            replace(reading, failure="The stripes do not follow the chips that were read.")
        )
    return _timed(reading, result, timing)


def _timed(reading: FrameReading, result: DecodeResult, timing: ChipTiming) -> TimedFrame:
    lattice, region = timing.lattice, result.region
    assert region is not None  # noqa: S101 - a signal is that of a region
    assert result.signal is not None  # noqa: S101 - the caller has asked
    count = len(result.signal)
    # In chips from the first one's start: where the first exposure starts and the last one ends.
    start = lattice.phase - lattice.first
    end = start + lattice.step * (count - 1) + lattice.exposure
    whole = int(np.ceil(start - _EDGE)), int(np.floor(end + _EDGE))
    whole = max(whole[0], 0), min(whole[1], len(lattice.values))
    return TimedFrame(
        replace(
            reading,
            chips=lattice.values,
            ratios=timing.ratios.astype(np.float32),
            whole=whole,
            chip_length=1.0 / lattice.step,
        ),
        middle=timing.middle - lattice.first,
        middle_error=timing.middle_error,
        column=region.first_column + 0.5 * (count - 1),
        step=lattice.step,
        step_error=timing.step_error,
    )

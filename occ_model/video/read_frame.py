"""Read one frame of a film: its chips, how sure each is, and their exact timing."""

from collections import deque
from dataclasses import dataclass, replace

import numpy as np

from occ_model.receiver.decode import decode
from occ_model.receiver.light import in_light
from occ_model.receiver.signal import column_means
from occ_model.results import Region
from occ_model.results.video import VideoFrame
from occ_model.results.video_reading import FrameReading
from occ_model.scene.scene import Scene
from occ_model.video.chip_timing import ChipTiming, fit_timing
from occ_model.video.first_lattice import first_lattice

_MOST_UNEXPLAINED = 0.3
"""Share of the signal's variance that the chips leave unexplained above which they are not read."""

_REMEMBERED = 5
"""Frames whose regions tell where the panel ends: it moves little from one to the next."""

_MOST_DARK = 6.0
"""Most dark chips in a row at an end of the panel: more than any line code has."""

_MARGIN = 0.5
"""Chips by which the panel may have moved since the frames that show where it ends."""

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


class FrameReader:
    """Reads frames one after the other.

    Parameters
    ----------
    scene
        What the receiver knows, roughly, as :func:`film_scene` gives it.
    decoder
        The name of the decoder that finds the chips.
    """

    def __init__(self, scene: Scene, decoder: str) -> None:
        self._scene, self._decoder = scene, decoder
        self._spans: deque[tuple[int, int]] = deque(maxlen=_REMEMBERED)

    def read(self, frame: VideoFrame) -> TimedFrame:
        """Read the chips of the next frame."""
        scene = self._scene
        if frame.exposure_time is not None:
            scene = scene.replace(exposure_time=frame.exposure_time)
        result = decode(frame.image, scene, self._decoder)
        reading = FrameReading(frame.index, frame.time, result.region)
        if result.region is None or result.signal is None or result.chip_starts is None:
            why = result.failure or "The decoder gives no chips, which joining frames needs."
            return TimedFrame(replace(reading, failure=why))
        region = self._with_dark_ends(result.region, scene)
        signal = column_means(frame.image, region)
        before = result.region.first_column - region.first_column
        lattice = first_lattice(result, signal, before, scene)
        if lattice is None:
            why = result.failure or "Too few stripes to see chips."
            return TimedFrame(replace(reading, failure=why))
        timing = fit_timing(in_light(signal, scene).values, lattice)
        if timing is None or timing.unexplained > _MOST_UNEXPLAINED:
            why = "The stripes do not follow the chips that were read."
            return TimedFrame(replace(reading, failure=why))
        after = region.last_column - result.region.last_column
        return _timed(reading, region, (before > 0, after > 0), timing)

    def _with_dark_ends(self, region: Region, scene: Scene) -> Region:
        """Widen a region by columns that frames before show: dark chips at its ends hide them."""
        first, last = region.first_column, region.last_column
        most = round(
            _MOST_DARK / (scene.camera.readout_time * scene.transmitter.switching_frequency)
        )
        self._spans.append((first, last))
        earliest = max(min(span[0] for span in self._spans), first - most, 0)
        latest = min(max(span[1] for span in self._spans), last + most)
        return replace(region, first_column=earliest, last_column=latest)


def _timed(
    reading: FrameReading, region: Region, dark_ends: tuple[bool, bool], timing: ChipTiming
) -> TimedFrame:
    lattice, count = timing.lattice, region.columns
    # In chips from the first one's start: where the first exposure starts and the last one ends.
    start = lattice.phase - lattice.first + _MARGIN * dark_ends[0]
    end = lattice.phase - lattice.first + lattice.step * (count - 1) + lattice.exposure
    end -= _MARGIN * dark_ends[1]
    whole = (
        max(int(np.ceil(start - _EDGE)), 0),
        min(int(np.floor(end + _EDGE)), len(lattice.values)),
    )
    ratios = timing.ratios.copy()
    for dark, outside in zip(dark_ends, (slice(0, whole[0]), slice(whole[1], None)), strict=True):
        if dark:  # they may lie beside the panel
            ratios[outside] = 0.0
    return TimedFrame(
        replace(
            reading,
            chips=lattice.values,
            ratios=ratios,
            whole=whole,
            chip_length=1.0 / lattice.step,
        ),
        middle=timing.middle - lattice.first,
        middle_error=timing.middle_error,
        column=region.first_column + 0.5 * (count - 1),
        step=lattice.step,
        step_error=timing.step_error,
    )

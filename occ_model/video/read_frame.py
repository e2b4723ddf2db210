"""Read one frame of a film: its chips, their certainty, and their exact timing."""

from collections import deque
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.photometry import WHITE
from occ_model.photo.chips.edges import Edges, chip_numbers, coherence, lattice_at
from occ_model.receiver.decode import decode, read_with
from occ_model.receiver.decoder import blame_short_chips, has_short_chips
from occ_model.receiver.light import convert_to_light
from occ_model.receiver.signal import column_means
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, Region
from occ_model.results.video import VideoFrame
from occ_model.results.video_reading import FrameReading
from occ_model.scene.scene import Scene
from occ_model.video.chip_timing import ChipLattice, ChipTiming, fit_timing

_MOST_CHIPS = 65_536  # in a frame; the longest packet has 57,116
_MAX_UNEXPLAINED = 0.3  # maximum fraction of the variance that the chips leave unexplained
_REMEMBERED_REGIONS = 5  # earlier frames that show the panel's ends, since it moves little
_MAX_DARK_CHIPS = 6.0  # in a row at an end of the panel, more than any line code allows

_MOTION_MARGIN = 0.5  # chips by which the panel may have moved since those frames
_ROUNDING_CHIPS = 1e-6  # rounding error in chips that does not cut a chip off

_WHITE_MEAN = WHITE - 1.0  # mean grey level from which a column counts as white
_MIN_EDGES = 4  # minimum number of edges between chips to find a lattice
_MAX_EDGE_ERROR = 0.3  # deviation in chips of an edge that shows a miscount

_SEARCHED_FRACTION = 0.05  # of the expected chip length, within which it is searched
_STEPS_A_TURN = 8.0  # chip lengths tried while the last edge moves by a chip


@dataclass(frozen=True, eq=False, slots=True)
class TimedFrame:
    reading: FrameReading
    # Middle of the exposure of ``column``, in chips from the first chip's start, and its error
    middle: float = 0.0
    middle_error: float = 0.0
    column: float = 0.0  # The middle column of the region, in the picture's columns
    # Chips per column, and their error
    step: float = 0.0
    step_error: float = 0.0
    # Why the frame by itself gives no payload, as for a single picture; None if it does
    problem: str | None = None
    white: float = 0.0  # Fraction of the panel's columns that are white in the camera's picture

    @property
    def is_read(self) -> bool:
        return bool(self.reading.chips.size)


def enhance_panel(image: ByteArray, region: Region, method: str) -> ByteArray:
    """Return the panel of a camera's picture, enhanced by its columns' means as in a receiver."""
    enhancement = Enhancement(column_means(image, region), method)
    return enhancement.enhance_bytes(np.ascontiguousarray(region.crop(image)))


def read_by_itself(
    image: ByteArray, scene: Scene, decoder: str = PAPER_DECODER
) -> tuple[DecodeResult, bool]:
    """Read a frame as the camera gives it, or enhanced if only that shows the payload.

    Also return whether it was enhanced, because the threshold refers to the picture that was read.
    """
    plain = decode(image, scene.replace(enhancement="none"), decoder)
    method, region = scene.model.enhancement, plain.region
    if plain.failure is None or region is None or method == "none":
        return plain, False
    signal = enhance_panel(image, region, method).mean(axis=0)
    enhanced = read_with(decoder, signal, scene)
    if enhanced.failure is not None:
        return plain, False
    return replace(enhanced, region=region, location=plain.location), True


class FrameReader:
    """Reads frames one after another, both as the camera gives them and enhanced.

    The chips' timing is fitted to the light of the camera's picture. Their values are read from
    both pictures, and those that explain the light better are used: an enhancement moves the
    threshold, so that some chips can be distinguished in only one of the pictures.
    """

    def __init__(self, scene: Scene, decoder: str) -> None:
        self.enhanced, self._scene = scene, scene.replace(enhancement="none")
        self.decoder = decoder
        self._spans: deque[tuple[int, int]] = deque(maxlen=_REMEMBERED_REGIONS)

    def read(self, frame: VideoFrame) -> TimedFrame:
        scene = self._with_exposure_of(self._scene, frame)
        result = decode(frame.image, scene, self.decoder)
        reading = FrameReading(frame.index, frame.time, result.region)
        if result.region is None:
            return TimedFrame(replace(reading, failure=result.failure))
        white_fraction = (
            0.0 if result.signal is None else float(np.mean(result.signal >= _WHITE_MEAN))
        )
        region = self._widen_by_dark_ends(result.region, scene)
        light = convert_to_light(column_means(frame.image, region), scene).values
        columns_before = result.region.first_column - region.first_column
        attempts = [
            _fit_timing(result, column_means(frame.image, region), light, columns_before, scene)
        ]
        if result.failure is not None and self.enhanced.model.enhancement != "none":
            attempts.append(self._read_enhanced(frame, result.region, region, light))
        timing, problem = min(
            attempts, key=lambda each: 1.0 if each[0] is None else each[0].unexplained
        )
        if timing is None:
            return TimedFrame(
                replace(reading, failure=problem), problem=problem, white=white_fraction
            )
        columns_after = region.last_column - result.region.last_column
        timed = _time_frame(reading, region, (columns_before > 0, columns_after > 0), timing)
        column = timed.column + frame.first_column
        return replace(timed, column=column, problem=problem, white=white_fraction)

    def _read_enhanced(
        self, frame: VideoFrame, panel: Region, region: Region, light: FloatArray
    ) -> tuple[ChipTiming | None, str | None]:
        """Read the chips of the enhanced picture, and fit their timing to the camera's light."""
        scene = self._with_exposure_of(self.enhanced, frame)
        signal = enhance_panel(frame.image, region, scene.model.enhancement).mean(axis=0)
        columns_before = panel.first_column - region.first_column
        panel_signal = signal[columns_before : columns_before + panel.columns]
        result = read_with(self.decoder, panel_signal, scene)
        return _fit_timing(result, signal, light, columns_before, scene)

    @staticmethod
    def _with_exposure_of(scene: Scene, frame: VideoFrame) -> Scene:
        exposure = frame.exposure_time
        return scene if exposure is None else scene.replace(exposure_time=exposure)

    def _widen_by_dark_ends(self, region: Region, scene: Scene) -> Region:
        """Widen a region by columns of earlier frames, which dark chips at its ends may hide."""
        first, last = region.first_column, region.last_column
        most_columns = round(
            _MAX_DARK_CHIPS / (scene.camera.readout_time * scene.transmitter.switching_frequency)
        )
        self._spans.append((first, last))
        earliest = max(min(span[0] for span in self._spans), first - most_columns, 0)
        latest = min(max(span[1] for span in self._spans), last + most_columns)
        return replace(region, first_column=earliest, last_column=latest)


def _fit_timing(
    result: DecodeResult, signal: FloatArray, light: FloatArray, columns_before: int, scene: Scene
) -> tuple[ChipTiming | None, str | None]:
    """Fit the timing of a decoder's chips; the second value states why they give no payload."""
    if result.signal is None or result.chip_starts is None:
        return (
            None,
            result.failure or "The decoder gives no chips, which are needed to join frames.",
        )
    lattice = fit_lattice(result, signal, columns_before, scene)
    if lattice is None:
        failure = result.failure or "The stripes show no regular chips."
        return None, blame_short_chips(failure, scene)
    timing = fit_timing(light, lattice)
    if timing is None or timing.unexplained > _MAX_UNEXPLAINED:
        return None, "The stripes do not follow the chips that were read."
    return timing, result.failure


def _time_frame(
    reading: FrameReading, region: Region, dark_ends: tuple[bool, bool], timing: ChipTiming
) -> TimedFrame:
    lattice, count = timing.lattice, region.columns
    # Start of the first exposure and end of the last one, in chips from the first one's start.
    start = lattice.phase - lattice.first + _MOTION_MARGIN * dark_ends[0]
    end = lattice.phase - lattice.first + lattice.step * (count - 1) + lattice.exposure
    end -= _MOTION_MARGIN * dark_ends[1]
    whole = (
        max(int(np.ceil(start - _ROUNDING_CHIPS)), 0),
        min(int(np.floor(end + _ROUNDING_CHIPS)), len(lattice.values)),
    )
    ratios = timing.ratios.copy()
    for is_dark_end, outside in zip(
        dark_ends, (slice(0, whole[0]), slice(whole[1], None)), strict=True
    ):
        if is_dark_end:  # these chips may lie beside the panel
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


def fit_lattice(
    result: DecodeResult, signal: FloatArray, columns_before: int, scene: Scene
) -> ChipLattice | None:
    """Place the chips of a decoder on a regular lattice; None if no lattice is found.

    There is none if chips are shorter than a column, or an exposure is longer than all columns.
    ``columns_before``: the number of the signal's columns before the result's region. The scene's
    exposure time and switching frequency are a first guess.
    """
    edges = np.flatnonzero(np.diff(result.chips.astype(np.int64))) + 1
    if result.chip_starts is None or len(edges) < _MIN_EDGES:
        return None
    starts = result.chip_starts + columns_before
    exposure = scene.camera.exposure_time * scene.transmitter.switching_frequency
    places, numbers = starts[edges], edges.astype(np.float64)
    rising = result.chips[edges] == 1
    step, offsets = _fit_line(places, numbers, rising)
    if step <= 0.0 or np.abs(offsets).max() > _MAX_EDGE_ERROR:
        if has_short_chips(scene):
            return None
        expected = scene.camera.readout_time * scene.transmitter.switching_frequency
        found = Edges(places, rising)
        step = _find_most_coherent(found, expected)
        numbers = np.rint(chip_numbers(found, lattice_at(found, step)))
    # Far more chips than columns can show, or an exposure longer than all columns.
    if not exposure <= step * len(signal) <= _MOST_CHIPS:
        return None
    # A chip is read in the column whose exposure has its middle within the chip.
    middle = float(np.mean(numbers - places * step))
    phase = middle - 0.5 * exposure
    lattice = _lay_out_chips(len(signal), step, phase, exposure)
    numbers = lattice.first + np.arange(len(lattice.values), dtype=np.float64)
    middles = np.asarray((numbers + 0.5 - middle) / step, dtype=np.float64)
    return replace(lattice, values=_read_values(result, starts, signal, middles))


def _fit_line(
    places: FloatArray, numbers: FloatArray, rising: BoolArray
) -> tuple[float, FloatArray]:
    """Fit a line through edges; return its chips per column, and each edge's deviation in chips."""
    design = np.column_stack([np.ones(len(places)), numbers, np.where(rising, 0.5, -0.5)])
    coefficients = np.linalg.lstsq(design, places, rcond=None)[0]
    if coefficients[1] * _MOST_CHIPS <= 1.0:  # not even a fraction of a column each
        return 0.0, np.zeros(len(places))
    return float(1.0 / coefficients[1]), np.asarray(
        (places - design @ coefficients) / coefficients[1]
    )


def _find_most_coherent(edges: Edges, expected: float) -> float:
    """Return the chips per column, near the expected number, whose lattice fits edges best."""
    extent = max(float(np.ptp(edges.place)), 1.0)
    search_range = max(_SEARCHED_FRACTION * expected, 1.0 / extent)
    count = int(np.ceil(2.0 * search_range * extent * _STEPS_A_TURN)) + 1
    steps = expected + np.linspace(-search_range, search_range, count)
    return float(steps[int(np.argmax(coherence(edges, steps)))])


def _lay_out_chips(columns: int, step: float, phase: float, exposure: float) -> ChipLattice:
    first = int(np.floor(phase))
    last = max(int(np.ceil(phase + step * (columns - 1) + exposure)), first + 1)
    return ChipLattice(step, phase, exposure, first, np.zeros(last - first, dtype=np.uint8))


def _read_values(
    result: DecodeResult, starts: FloatArray, signal: FloatArray, middles: FloatArray
) -> ByteArray:
    """Read each chip in the column whose exposure has the same middle."""
    nearest = np.clip(np.rint(middles), 0, len(signal) - 1).astype(np.int64)
    if result.threshold is not None:
        return np.asarray(signal[nearest] > result.threshold, dtype=np.uint8)
    indices = np.clip(np.searchsorted(starts, nearest, side="right") - 1, 0, len(starts) - 1)
    return np.asarray(result.chips[indices])

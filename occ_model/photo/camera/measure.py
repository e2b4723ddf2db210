"""Measure a camera by two pictures of a room, or one of a wall, under lamps on the mains."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from occ_model.errors import MatchError, ParameterError, inflect
from occ_model.photo.camera.bars_fit import BarsFit, fit_bars, search_bars
from occ_model.photo.camera.quotient import quotient_of_lines
from occ_model.photo.camera.verdict import LEAST_FOR_ANY, doubts, refuse
from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.results.camera import HARMONIC, CameraMeasurement
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.parameters import quantity

_MAINS_ERROR = 4e-4
"""Relative standard deviation of a mains' frequency: 20 mHz of 50 Hz in continental Europe."""

MOST_PICTURES = 2


def measure_camera(
    photos: Sequence[Photo | str | Path],
    mains_frequency: float = 50.0,
    *,
    scan_axis: str = SCAN_AXES[0],
    progress: Callable[[float], object] | None = None,
) -> CameraMeasurement:
    """Measure how fast a camera reads its lines, by the bars that mains lamps make.

    Where two pictures are divided, the room cancels, and the bars stay, which are elsewhere in the
    second picture, or absent from it after a long exposure.

    Parameters
    ----------
    photos
        Two pictures of one room by one camera, such as two of a burst at 1/1000 s, or a short and a
        long exposure; or one of an even wall. Photos, or files. They have to be whole: not cropped,
        and without a lens correction.
    mains_frequency
        Frequency of the mains in Hz: 50 or 60 in most countries. The light swings at twice that.
    scan_axis
        ``"lines"`` or ``"columns"`` of the upright picture, or ``"auto"``: what shows bars.
    progress
        Called with the fraction of the work that is done. What it raises ends the work.

    Raises
    ------
    MatchError
        The pictures show no bars, or bars that cannot be measured; the reasons say why.
    ParameterError
        There are more than two photos or none, they differ in size, or an argument is not allowed.
    PhotoError
        A file cannot be read.
    """
    report = progress or (lambda _fraction: None)
    check_choice("scan_axis", scan_axis, SCAN_AXES)
    quantity("mains_frequency").check(mains_frequency)
    loaded = _load(photos)
    report(0.2)
    axes = [scan_axis] if scan_axis != SCAN_AXES[0] else list(SCAN_AXES[1:])
    found = []
    for number, axis in enumerate(axes, 1):
        lines = quotient_of_lines(loaded, axis)
        fit = fit_bars(search_bars(lines))
        found.append((axis, lines, fit, doubts(lines, fit, is_single=len(loaded) == 1)))
        report(0.2 + 0.7 * number / len(axes))
    axis, lines, fit, reasons = max(
        found, key=lambda each: (each[2].gap_to_none > LEAST_FOR_ANY, -len(each[3]),
                                 each[2].gap_to_none)
    )  # fmt: skip
    refuse(loaded, axes, lines, fit)
    report(1.0)
    frequency = HARMONIC * mains_frequency
    frame = fit.bars / frequency
    relative = math.hypot(fit.deviation / fit.bars, _MAINS_ERROR)
    waves = np.log((1.0 + fit.clipped_waves) / (1.0 - fit.clipped_waves))
    depth = _depth(waves)
    return CameraMeasurement(
        mains_frequency=float(mains_frequency),
        bars=fit.bars,
        readout_time=frame / lines.lines,
        frame_readout_time=frame,
        uncertainties={
            "bars": fit.deviation,
            "readout_time": relative * frame / lines.lines,
            "frame_readout_time": relative * frame,
        },
        scan_axis=axis,
        lines=lines.lines,
        pictures=len(loaded),
        depth=depth,
        longest_exposure=_longest_exposure(depth, fit, frequency) if len(loaded) == 1 else None,
        waves=waves,
        reasons=tuple(reasons),
        other_bars=None if math.isnan(fit.other) else fit.other,
    )


def _load(photos: Sequence[Photo | str | Path]) -> list[Photo]:
    if not 1 <= len(photos) <= MOST_PICTURES:
        raise ParameterError.of(
            "photos", inflect(len(photos), "picture"), "two pictures of a room, or one of a wall"
        )
    loaded: list[Photo] = []
    for each in photos:
        channel = loaded[0].channel if loaded else "brightest"
        channel = "brightest" if channel == "grey" else channel
        loaded.append(each if isinstance(each, Photo) else load_photo(each, channel=channel))
    sizes = [_upright_size(photo) for photo in loaded]
    if len(set(sizes)) > 1:
        (first, second) = sizes
        raise MatchError(
            f"The pictures have {first[0]:,} and {second[0]:,} lines, {first[1]:,} and "
            f"{second[1]:,} columns; allowed: two of the same size, by the same camera."
        )
    return loaded


def _upright_size(photo: Photo) -> tuple[int, int]:
    rows, columns = photo.samples.shape
    return (columns, rows) if photo.turned else (rows, columns)


def _depth(waves: np.ndarray) -> float:
    """Return the depth of the bars in the tile where they are deepest."""
    swing = float((waves.max(axis=1) - waves.min(axis=1)).max())
    return math.tanh(0.5 * swing)


def _longest_exposure(depth: float, fit: BarsFit, frequency: float) -> float:
    """Return the exposure time above which no light makes bars as deep.

    An exposure of n whole cycles and a part gathers at least n and at most n + 1 cycles of light:
    a depth of at most 1 / (2 n + 1).
    """
    least = max(depth - 3.0 * fit.residual, 1e-3)
    return (math.floor(0.5 * (1.0 / least - 1.0)) + 1) / frequency

"""Measure a camera by two pictures of a room, or one of a wall, under lamps on the mains."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from occ_model.errors import MatchError, ParameterError, inflect
from occ_model.photo.camera.bars_fit import BarsFit, fit_bars
from occ_model.photo.camera.quotient import TILES, LineValues, quotient_of_lines
from occ_model.photo.camera.verdict import (
    LEAST_FOR_ANY,
    doubts,
    refuse,
    refuse_unseen,
    stated_deviation,
    tilt_of,
)
from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.results.camera import CameraMeasurement
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.light_words import MAINS_HARMONIC
from occ_model.scene.parameters import quantity

_MAINS_ERROR = 4e-4
"""Relative standard deviation of a mains' frequency: 20 mHz of 50 Hz in continental Europe."""

MOST_PICTURES = 2
_FEWEST_LINES = 40  # on which eight bars could still be seen


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
        long exposure; or one of an even wall, whose measure is always doubtful. Photos, or files.
        They have to be whole: not cropped, and without a lens correction.
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
    axes = _axes(loaded[0], scan_axis)
    found = []
    for number, axis in enumerate(axes, 1):
        lines = quotient_of_lines(loaded, axis)
        refuse_unseen(lines)
        found.append(_AxisBars(axis, lines, fit_bars(lines), len(loaded) == 1))
        report(0.2 + 0.7 * number / len(axes))
    best = max(found, key=_AxisBars.credit)
    refuse(loaded, axes, best.lines, best.fit)
    report(1.0)
    return _result(best, float(mains_frequency))


def _result(best: "_AxisBars", mains_frequency: float) -> CameraMeasurement:
    fit, lines, is_single = best.fit, best.lines, best.is_single
    frequency = MAINS_HARMONIC * mains_frequency
    frame = fit.bars / frequency
    deviation = stated_deviation(fit)
    relative = math.hypot(deviation / fit.bars, _MAINS_ERROR)
    waves = np.log((1.0 + fit.clipped_waves) / (1.0 - fit.clipped_waves))
    depth = _depth(waves)
    return CameraMeasurement(
        mains_frequency=mains_frequency,
        bars=fit.bars,
        readout_time=frame / lines.lines,
        frame_readout_time=frame,
        uncertainties={
            "bars": deviation,
            "readout_time": relative * frame / lines.lines,
            "frame_readout_time": relative * frame,
        },
        scan_axis=best.axis,
        lines=lines.lines,
        pictures=1 if is_single else MOST_PICTURES,
        depth=depth,
        longest_exposure=_longest_exposure(depth, fit, frequency) if is_single else None,
        waves=waves,
        reasons=tuple(doubts(fit, is_single=is_single)),
        other_bars=None if math.isnan(fit.other) else fit.other,
    )


@dataclass(frozen=True, eq=False, slots=True)
class _AxisBars:
    """The bars along one axis of the pictures."""

    axis: str
    lines: LineValues
    fit: BarsFit
    is_single: bool

    def credit(self) -> tuple[float, ...]:
        """Return what axes are ordered by: how level bars of one picture are, else their doubts."""
        fit, shows_any = self.fit, self.fit.gap_to_none > LEAST_FOR_ANY
        if self.is_single:
            return (shows_any, -tilt_of(self.lines, fit).largest)
        return (shows_any, -len(doubts(fit, is_single=False)), fit.gap_to_none)


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


def _axes(photo: Photo, scan_axis: str) -> list[str]:
    """Return the axes along which a picture is large enough, of that one or of both."""
    lines, columns = _upright_size(photo)
    sizes = {"lines": (lines, columns), "columns": (columns, lines)}
    wanted = [scan_axis] if scan_axis in sizes else list(sizes)
    axes = [axis for axis in wanted if sizes[axis][0] >= _FEWEST_LINES and sizes[axis][1] >= TILES]
    if not axes:
        raise MatchError(
            f"The picture has {lines:,} lines and {columns:,} columns; allowed: at least "
            f"{_FEWEST_LINES} that are read one by one, of at least {TILES} pixels."
        )
    return axes


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

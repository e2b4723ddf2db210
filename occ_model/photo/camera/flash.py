"""Measure a camera by the band that one flash leaves in a picture.

A line gathers what its exposure t shares with the flash of length F. From line to line this is a
trapezoid, (F + t) / r lines long with a readout time r, and max(F, t) / r at half of its height;
each of its slopes has min(F, t) / r.
"""

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.errors import MatchError, inflect
from occ_model.photo.lamp_fit.tone import PowerTone
from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.photo.stripes.period import correlated_columns
from occ_model.results.flash import FlashMeasurement
from occ_model.scene.parameters import quantity
from occ_model.scene.units import SECOND

_LEAST_SWING = 12.0  # grey levels
_SMOOTHED = 5  # lines over which the band is looked for
_MOST_MISFIT, _DOUBTED_MISFIT = 0.12, 0.05  # root mean square, as fractions of the swing

# Means and deviations of the logarithm of the wall's brightness, its slope and its bend from the
# middle to the ends, and of the tone curve: logarithms of gamma and of the toe, and the bend.
_LIKELY = np.array([0.0, 0.0, math.log(2.2), math.log(0.002), 0.0])
_DEVIATIONS = np.array([0.7, 0.7, 0.18, 1.2, 0.2])
_LEAST = [0.0, 2.0, 0.05, 0.0, -12.0, -3.0, -3.0, -0.1, -11.0, -0.9]
_MOST = [1.0, 3.0, 3.0, 3.0, 1.8, -1.0, 0.9]  # from the ambient light
_SCALES = [1.0, 1.0, 1.0, 0.01, 0.1, 0.1, 0.1, 0.1, 0.5, 0.1]

_SLOPE_ERROR, _LINE_ERROR = 0.006, 0.03  # of an edge's lines, and lines: by the tone curve, by blur
_LEAST_EDGE = 1.5  # lines, from which a slope is known
_ALIKE = 1.25  # ratio of flash and exposure below which the note does not tell which is longer


def measure_flash(
    photo: Photo | str | Path, flash: float, *, scan_axis: str = SCAN_AXES[0]
) -> FlashMeasurement:
    """Measure how fast a camera reads its lines, by the band of one flash of known length.

    Parameters
    ----------
    photo
        A picture of an even wall with one flash, the band of which is in view from its begin to its
        end; or a file, which is read along ``scan_axis``.
    flash
        Length of the flash in seconds.
    scan_axis
        As in :func:`occ_model.load_photo`; not used for a photo that is loaded.

    Raises
    ------
    MatchError
        There is no band, there are several, it is cut, or no flash makes its shape.
    ParameterError
        ``flash`` is not a time that an exposure may have, or ``scan_axis`` not one of its words.
    PhotoError
        The file cannot be read.
    """
    replace(quantity("exposure_time"), name="flash").check(flash)
    loaded = photo if isinstance(photo, Photo) else load_photo(photo, scan_axis)
    fit = _fit(np.asarray(loaded.profile, dtype=np.float64), _find_band(loaded.profile))
    band, edge = fit.band, fit.edge
    noted = loaded.exposure_time
    is_longer = noted is None or noted < flash  # the flash is longer than the exposure
    known, other = (band, edge) if is_longer else (edge, band)
    error, other_error = fit.errors if is_longer else fit.errors[::-1]
    readout = flash / known
    exposure = readout * other
    count = len(loaded.profile)
    relative = error / known
    other_readout = flash / other
    return FlashMeasurement(
        flash=float(flash),
        readout_time=readout,
        frame_readout_time=readout * count,
        exposure_time=exposure,
        uncertainties={
            "readout_time": readout * relative,
            "frame_readout_time": readout * relative * count,
            "exposure_time": exposure * math.hypot(relative, other_error / other),
        },
        band=band,
        edge=edge,
        scan_axis="lines" if loaded.turned else "columns",
        lines=count,
        reasons=tuple(_doubts(fit, flash, noted, other_readout)),
        other_readout_time=other_readout if noted is None else None,
    )


def _find_band(profile: FloatArray) -> tuple[int, int]:
    """Return the first line of a bright band at half of its height, and the line after the last."""
    smooth = np.convolve(np.pad(profile, _SMOOTHED // 2, mode="edge"), np.full(_SMOOTHED, 0.2),
                         mode="valid")  # fmt: skip
    low, high = float(smooth.min()), float(smooth.max())
    if high - low < _LEAST_SWING:
        raise MatchError(
            f"No band of a flash: the lines differ by {high - low:.2g} grey levels; at least "
            f"{_LEAST_SWING:g} are needed."
        )
    above = smooth > 0.5 * (low + high)
    ends = np.flatnonzero(np.diff(above, prepend=False, append=False))
    bands = ends.reshape(-1, 2).tolist()
    if len(bands) > 1:
        raise MatchError(
            f"The picture shows {len(bands)} bright bands; one flash leaves one. If a lamp blinks, "
            "match the picture with its frequency."
        )
    first, last = bands[0]
    return int(first), int(last)


@dataclass(frozen=True, eq=False, slots=True)
class _BandFit:
    """The trapezoid of a band."""

    band: float  # Lines at half of its height
    edge: float  # Lines of each of its slopes
    errors: tuple[float, float]  # Standard deviations of both
    misfit: float  # Root mean square of the residual, as a fraction of the swing


def _fit(profile: FloatArray, inside: tuple[int, int]) -> _BandFit:
    from scipy.optimize import least_squares  # slow to import, and needed only for photos

    count = len(profile)
    lines = np.arange(count, dtype=np.float64)
    swing = float(np.ptp(profile))
    noise = max(1.4826 * float(np.median(np.abs(np.diff(profile)))) / math.sqrt(2.0), 0.1)
    first, last = inside

    def residual_of(values: FloatArray) -> FloatArray:
        model = _levels(lines, values)
        return np.concatenate([(model - profile) / noise, (values[5:] - _LIKELY) / _DEVIATIONS])

    def fit_from(edge: float) -> tuple[float, FloatArray, FloatArray]:
        low, high = np.clip(np.array([profile.min(), profile.max()]) / WHITE, 1e-3, 1.0) ** 2.2
        start = [0.5 * (first + last), last - first, edge, low, math.log(high - low + 1e-3)]
        found = least_squares(
            residual_of, np.concatenate([start, _LIKELY]),
            bounds=(_LEAST, [count, 2 * count, count, *_MOST]), x_scale=_SCALES, max_nfev=60,
        )  # fmt: skip
        return float(found.cost), np.asarray(found.x), np.asarray(found.jac)

    _, values, slopes = min(
        (fit_from(part * (last - first)) for part in (0.05, 0.3, 0.8)), key=lambda each: each[0]
    )
    residual = residual_of(values)[:count]
    variance = float(residual @ residual) / (count - len(values)) * correlated_columns(residual)
    # The priors keep their own weight, whatever the lines scatter.
    products = slopes[:count].T @ slopes[:count] / max(variance, 1.0)
    products += slopes[count:].T @ slopes[count:]
    deviations = np.sqrt(np.diag(np.linalg.pinv(products)))
    middle, band, edge = values[:3].tolist()
    band, edge = max(band, edge), min(band, edge)
    misfit = noise * math.sqrt(float(residual @ residual) / count) / swing
    if misfit > _MOST_MISFIT:
        raise MatchError(
            f"The band is not a flash's: its shape differs by {100.0 * misfit:.2g} % of its height "
            f"from a plateau between two equal slopes; at most {100.0 * _MOST_MISFIT:.0f} %."
        )
    reach = 0.5 * (band + edge)
    if middle - reach < 0.0 or middle + reach > count:
        raise MatchError(
            f"The band is cut: it would need {inflect(round(2.0 * reach), 'line')} about line "
            f"{middle:.0f}, of {count:,}. Flash earlier or later in the frame, or shorter."
        )
    # What the tone curve differs from its model moves both in proportion to the slopes.
    unknown = math.hypot(_SLOPE_ERROR * edge, _LINE_ERROR)
    errors = math.hypot(deviations[1], unknown), math.hypot(deviations[2], unknown)
    return _BandFit(band, edge, errors, misfit)


def _levels(lines: FloatArray, values: FloatArray) -> FloatArray:
    """Return the grey levels of a trapezoid of light on a wall that is unevenly bright."""
    middle, band, edge, ambient, height, slope, bend, gamma, toe, shoulder = values.tolist()
    band, edge = max(band, edge), min(band, edge)
    along = np.clip((0.5 * (band + edge) - np.abs(lines - middle)) / max(edge, 0.05), 0.0, 1.0)
    place = np.linspace(-1.0, 1.0, len(lines))
    wall = np.exp(slope * place + bend * place**2)
    light = wall * (ambient + math.exp(height) * along)
    return WHITE * PowerTone(math.exp(gamma), math.exp(toe), shoulder).levels(
        np.minimum(light, 1.0)
    )


def _doubts(fit: _BandFit, flash: float, noted: float | None, other: float) -> list[str]:
    found = []
    if noted is None:
        found.append(
            "The photo notes no exposure time: if the exposure is longer than the flash, a line is "
            f"read in {SECOND.format(other, 3)}."
        )
    elif max(noted / flash, flash / noted) < _ALIKE:
        found.append(
            f"The noted exposure of {SECOND.format(noted, 3)} is about as long as the flash, so "
            "that either may make the slopes."
        )
    if noted is not None and noted > flash and fit.edge < _LEAST_EDGE:
        found.append(
            f"The band's slopes have {fit.edge:.2g} lines; to measure a flash that is shorter than "
            f"the exposure takes at least {_LEAST_EDGE:g}."
        )
    if fit.misfit > _DOUBTED_MISFIT:
        found.append(
            f"The band's shape differs by {100.0 * fit.misfit:.2g} % of its height from a flash's; "
            f"at most {100.0 * _DOUBTED_MISFIT:.0f} %."
        )
    return found

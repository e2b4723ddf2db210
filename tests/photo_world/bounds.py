"""Cramer-Rao bounds of the times measured in a photograph of a known world."""

from dataclasses import replace

import numpy as np

from occ_model.photo.fit.joint_model import PRIORS
from occ_model.photo.stripes.envelope import smooth_shapes
from photo_world.photograph import World, blurred, falloff, lit_fraction, scale
from photo_world.pixel_noise import jpeg_covariance, whiten

_ROWS = 8
"""Rows that count as equally bright: those of a block of JPEG."""

_LEVELS = 3
"""Shapes of which the lamp's light, and the surroundings', is a combination along the columns."""

_CHANGE = 1e-3
"""Columns by which a time is changed for finite differences, over all of them."""

_OF_BLUR = 0.02
_REACH = 25
"""Columns up to which the noise of two pixels is correlated: twice the blur's reach, and one."""


def bound_of_light(world: World) -> tuple[float, float]:
    """Return the bound of the readout and the exposure time by light alone, as relative deviations.

    A pixel at row r and column i gathers m = W (b(r, i) lit(i) + a(r, i)) electrons on average, W
    being the full well, b the lamp's light and a the surroundings'. Their number is normal with the
    variance m + s^2 (shot and read noise). For parameters p the Fisher information is

        F = sum over r, i of (dm/dp) (dm/dp)^T / (m + s^2)

    (Kay, Fundamentals of Statistical Signal Processing, 3.9; the variance's own dependence on p,
    of the order 1/m, is left out). Of p = (t_r, t, t_0, ln b, ln a) the last three are unknown too,
    and the bounds of t_r and t are the roots of the diagonal of F's inverse. What follows in the
    camera (tone curve, blur, rounding, JPEG) is known and loses nothing; clipped pixels tell
    nothing but "at least white", and are left out. So no estimate does better.
    """
    lamp, dark = _lights(world)
    lit = lit_fraction(world)[None, :]
    mean = world.full_well * (lamp * lit + dark)
    slopes = [world.full_well * lamp * slope[None, :] for slope in _slopes_of_times(world)]
    slopes += [world.full_well * lamp * lit, world.full_well * dark * np.ones_like(lit)]
    seen = mean < world.full_well
    weight = np.where(seen, 1.0 / (mean + world.read_noise**2), 0.0)
    information = np.array([[float((weight * a * b).sum()) for b in slopes] for a in slopes])
    return _of_times(information)


def bound_of_picture(world: World, *, camera_known: bool = False) -> tuple[float, float]:
    """Return the bound by the stored picture, with the unknowns that a match has.

    A pixel's value is the tone curve of the light, blurred before or after it. Its noise is that of
    the light, blurred as well; of rounding, twice, 1/12 each; and of JPEG, which rounds the cosine
    coefficients of a block to multiples of steps q: q^2/12 each, independent of each other and of
    other blocks (which is hopeful: without noise they are the same in all blocks of a column). With
    the covariance C of a row of pixels, F is the sum over rows of (dv/dp)^T C^-1 (dv/dp).

    Unknown are t_r, t and t_0; the levels a and b, each as a combination of shapes along the
    columns; and the camera: the tone curve's gamma, offset, shoulder and contrast, the blur's
    width, and how much longer the LED is on. What is usual of the camera is known beforehand: its
    prior's information is added to F (van Trees, Detection, Estimation, and Modulation Theory I,
    2.4), as in a match.

    ``world``: the photograph's truth. ``camera_known``: whether the camera is known exactly, so
    that only the noise differs from light alone.
    """
    lamp, dark = _lights(world)
    slopes = _slopes_of_times(world)
    longer = _slope_of_longer(world)
    lit = lit_fraction(world)
    shapes = smooth_shapes(world.columns, _LEVELS).T
    information = np.zeros((3 + 2 * _LEVELS + len(PRIORS),) * 2)
    for first in range(0, world.rows, _ROWS):
        rows = slice(first, first + _ROWS)
        b, a = lamp[rows].mean(axis=0), dark[rows].mean(axis=0)
        count = len(lamp[rows])
        of_light = [*(b * slope for slope in slopes), *(b * lit * shapes), *(a * shapes)]
        information += count * _of_row(world, b * lit + a, of_light, b * longer)
    camera = slice(3 + 2 * _LEVELS, None)
    prior = 1e12 if camera_known else 1.0 / np.array([sd for _, sd in PRIORS.values()]) ** 2
    information[camera, camera] += np.diag(np.broadcast_to(prior, len(PRIORS)))
    return _of_times(information)


def _lights(world: World) -> tuple[np.ndarray, np.ndarray]:
    """Return the lamp's light and the surroundings' in each pixel; 1 makes white."""
    passed = falloff(world) * scale(world)
    return world.lamp.brightness(world.rows, world.columns) * passed, world.ambient * passed


def _slopes_of_times(world: World) -> list[np.ndarray]:
    """Return the lit fraction's slopes over readout, exposure and start time, by relative changes.

    The start is that of the middle column, relative to the exposure.
    """
    slopes = []
    for name in ("readout_time", "exposure_time", "start_time"):
        unit = world.readout_time if name == "readout_time" else world.exposure_time
        change = _CHANGE * unit / (world.columns if name == "readout_time" else 1)
        moved = [
            lit_fraction(replace(world, **{name: getattr(world, name) + sign * change}))
            for sign in (-1.0, 1.0)
        ]
        slopes.append((moved[1] - moved[0]) * (unit / (2.0 * change)))
    return slopes


def _slope_of_longer(world: World) -> np.ndarray:
    """Return the lit fraction's slope over the chips by which the LED is on longer.

    Each edge of the chips moves by half of it, so that each edge within an exposure adds half.
    """
    chips = np.array([int(chip) for chip in world.chips])
    turns = np.flatnonzero(chips != np.roll(chips, 1))
    begin = world.start_time + world.readout_time * np.arange(world.columns)
    begin = begin * world.switching_frequency

    def edges_before(place: np.ndarray) -> np.ndarray:
        periods = np.floor(place / len(chips))
        within = place - periods * len(chips)
        return np.asarray(periods * len(turns) + np.searchsorted(turns, within, side="right"))

    count = edges_before(begin + world.exposure_in_chips) - edges_before(begin)
    return np.asarray(0.5 * count / world.exposure_in_chips)


def _of_row(
    world: World, light: np.ndarray, of_light: list[np.ndarray], longer: np.ndarray
) -> np.ndarray:
    """Return the Fisher information of a row of pixels."""
    seen = light < 1.0
    noise = np.where(seen, (light * world.full_well + world.read_noise**2), 0.0)
    noise = noise / world.full_well**2
    clipped = np.clip(light, 0.0, 1.0)
    changes = np.where(seen, np.stack([*of_light, longer]), 0.0)

    def tone(values: np.ndarray) -> np.ndarray:
        return np.asarray(255.0 * world.curve(np.clip(values, 0.0, 1.0)))

    def slope(values: np.ndarray) -> np.ndarray:
        # Where there is less light than its noise, noise makes the curve straight.
        least = np.sqrt(noise) + 1e-4
        at = np.clip(values, least, 1.0 - 1e-4)
        return np.asarray((tone(at + 1e-4) - tone(at - 1e-4)) / 2e-4)

    def picture(blur: float) -> np.ndarray:
        if world.blur_of_values:
            return _blurred(world, tone(clipped), blur)
        return tone(_blurred(world, clipped, blur))

    kernel = _blurred(world, np.eye(2 * _REACH + 1)[_REACH], world.blur)
    if world.blur_of_values:
        before, after = slope(clipped), np.ones_like(light)
    else:
        before, after = np.ones_like(light), slope(_blurred(world, clipped, world.blur))
    timing = np.stack([after * _blurred(world, before * one, world.blur) for one in changes])
    more, less = world.blur + _OF_BLUR, max(world.blur - _OF_BLUR, 0.0)
    of_blur = (picture(more) - picture(less)) / (more - less)
    # The bends of the curve, by the pixel value u as a fraction of white.
    u = picture(world.blur) / 255.0
    bends = [
        -u * np.log(np.maximum(u, 1e-3)), 1.0 - u, u * (1.0 - u), u * (1.0 - u) * (1.0 - 2.0 * u)
    ]  # fmt: skip
    slopes = np.stack([*timing[:-1], *(255.0 * bend for bend in bends), of_blur, timing[-1]])
    bands = _of_light(noise * before**2, kernel, after)
    bands[0] += 2.0 / 12.0
    bands[:8] += jpeg_covariance(world)
    white = whiten(bands, slopes)
    return np.asarray(white @ white.T)


def _blurred(world: World, row: np.ndarray, blur: float) -> np.ndarray:
    """Blur a row as a picture whose rows are all alike."""
    return np.asarray(blurred(np.tile(row, (3, 1)), blur, world.blur_shape)[1])


def _of_light(noise: np.ndarray, kernel: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Return the covariance of a row's light, as its diagonals from the main one downwards.

    ``noise``: its variance before it is blurred by a kernel. ``after``: what then multiplies it.
    """
    columns = len(noise)
    bands = np.zeros((_REACH, columns))
    padded = np.pad(noise, _REACH, mode="reflect")
    for apart in range(_REACH):
        both = kernel[: len(kernel) - apart] * kernel[apart:]
        # The covariance of pixels i and i + apart: sum over j of k(i-j) k(i+apart-j) noise(j).
        spread = np.convolve(padded, np.pad(both, (0, apart)), "same")
        bands[apart] = spread[_REACH : _REACH + columns] * after
        bands[apart, : columns - apart] *= after[apart:]
        bands[apart, columns - apart :] = 0.0
    return bands


def _of_times(information: np.ndarray) -> tuple[float, float]:
    unit = np.sqrt(np.maximum(np.diag(information), 1e-300))
    inverse = np.linalg.inv(information / np.outer(unit, unit) + 1e-12 * np.eye(len(unit)))
    deviations = np.sqrt(np.diag(inverse)) / unit
    return float(deviations[0]), float(deviations[1])

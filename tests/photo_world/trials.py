"""Matches of photographs whose truth is known: how far off they are, by what they state."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from simulated_photos import photo_of

import occ_model as occ
from photo_world.photograph import (
    KNOWN_GAMMA,
    World,
    falloff,
    lit_fraction,
    photograph,
    random_world,
    scale,
)

SATURATION_THIRDS = (0.0, 0.2, 0.4, 0.6)
"""Shares of saturated pixels that divide the photographs."""


@dataclass(frozen=True)
class Trial:
    """One photograph, matched.

    Parameters
    ----------
    saturated
        Share of the lamp's pixels that are white.
    readout, exposure
        Relative errors.
    readout_deviation, exposure_deviation
        Relative standard deviations, as stated.
    readout_bound, exposure_bound
        Relative standard deviations that no unbiased estimate can fall below.
    doubts
        Why the match is not sure.
    failure
        Why there is none.
    """

    world: World
    saturated: float
    readout: float = np.nan
    exposure: float = np.nan
    readout_deviation: float = np.nan
    exposure_deviation: float = np.nan
    readout_bound: float = np.nan
    exposure_bound: float = np.nan
    doubts: tuple[str, ...] = ()
    failure: str = ""

    @property
    def is_sure(self) -> bool:
        """Whether there is a match without any doubt."""
        return not self.failure and not self.doubts


def told(world: World) -> occ.Scene:
    """Give a scene that holds what is told of a photograph: the chips and their frequency."""
    return occ.load_preset("phone-68us").replace(
        pattern=world.chips,
        switching_frequency=world.switching_frequency,
        gamma=KNOWN_GAMMA,
        readout_time=1e-6,
        exposure_time=1.0,
        start_time=0.0,
    )


def trial(world: World) -> Trial:
    """Take a photograph and match it."""
    image = photograph(world)
    covers = world.lamp.covers(world.rows, world.columns)
    saturated = float(np.mean(image[covers] >= 254))
    try:
        match = occ.match_photo(photo_of(image), told(world), sent="scene")
    except occ.MatchError as why:
        return Trial(world, saturated, failure=str(why))
    bounds = bound(world)
    return Trial(
        world,
        saturated,
        match.readout_time / world.readout_time - 1.0,
        match.exposure_time / world.exposure_time - 1.0,
        match.uncertainties["readout_time"] / world.readout_time,
        match.uncertainties["exposure_time"] / world.exposure_time,
        *bounds,
        doubts=match.reasons,
    )


def trials(seeds: Iterable[int]) -> Iterator[Trial]:
    """Match the photographs of some seeds, one after the other."""
    return (trial(random_world(seed)) for seed in seeds)


def bound(world: World) -> tuple[float, float]:
    """Give the Cramer-Rao bound of the readout and the exposure time, as relative deviations.

    A pixel at row r and column i gathers m = W (b(r, i) lit(i) + a(r, i)) electrons on average, W
    being the full well, b the lamp's light and a the surroundings'. Their number is normal with the
    variance m + s^2 (shot and read noise). For parameters p the Fisher information is

        F = sum over r, i of (dm/dp) (dm/dp)^T / (m + s^2)

    (Kay, Fundamentals of Statistical Signal Processing, 3.9; the variance's own dependence on p,
    of the order 1/m, is left out). Of p = (t_r, t, t_0, ln b, ln a) the last three are unknown too,
    and the bounds of t_r and t are the roots of the diagonal of F's inverse. What follows in the
    camera (tone curve, blur, rounding, JPEG) is the same for all p and can only lose information;
    clipped pixels tell nothing but "at least white", and are left out. So no estimate does better.
    """
    rows, columns = world.rows, world.columns
    lamp = world.lamp.brightness(rows, columns) * falloff(world) * scale(world)
    dark = world.ambient * falloff(world) * scale(world)
    lit = lit_fraction(world)[None, :]
    mean = world.full_well * (lamp * lit + dark)
    slopes = []
    for name in ("readout_time", "exposure_time", "start_time"):
        unit = world.readout_time if name == "readout_time" else world.exposure_time
        change = 1e-3 * unit / (columns if name == "readout_time" else 1)
        moved = [
            lit_fraction(replace(world, **{name: getattr(world, name) + sign * change}))
            for sign in (-1.0, 1.0)
        ]
        slope = (moved[1] - moved[0])[None, :] * (unit / (2.0 * change))
        slopes.append(world.full_well * lamp * slope)
    slopes += [world.full_well * lamp * lit, world.full_well * dark * np.ones_like(lit)]
    seen = mean < world.full_well
    weight = np.where(seen, 1.0 / (mean + world.read_noise**2), 0.0)
    information = np.array([[float((weight * a * b).sum()) for b in slopes] for a in slopes])
    variance = np.diag(np.linalg.inv(information))
    return float(np.sqrt(variance[0])), float(np.sqrt(variance[1]))

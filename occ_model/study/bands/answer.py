"""State which shutter speeds show no bars of a lamp, and how its bars move in films."""

import math
from fractions import Fraction

import numpy as np

from occ_model.errors import ParameterError, quote
from occ_model.results.bands import NO_BARS_DEPTH, SpeedDepth
from occ_model.results.bars_answer import ROWS, BarsAnswer, Beat, FrameRateBeats, UnlitRows
from occ_model.scene.light_words import describe_light, has_chips
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import speed_depths
from occ_model.study.bands.depth import light_depth, light_fractions
from occ_model.study.bands.sines import repeat_time, sines_of

FRAME_RATES = {
    "23.976": Fraction(24000, 1001), "24": Fraction(24), "25": Fraction(25),
    "29.97": Fraction(30000, 1001), "30": Fraction(30), "48": Fraction(48), "50": Fraction(50),
    "59.94": Fraction(60000, 1001), "60": Fraction(60), "100": Fraction(100),
    "120": Fraction(120), "240": Fraction(240),
}  # fmt: skip
"""Usual frame rates, as written and exactly."""

_ROUNDING_ROWS = 1e-9  # difference from whole cycles, in rows, that is a rounding error

_LARGEST_RATIO = 32.0  # longer of an advised shutter time and the scene's, over the shorter
_MOST_SPEEDS = 2
_SINES_PER_PIECE = 4  # sines that are searched per duration of the shortest piece of light
_MOST_SINES = 5


def bars_answer(scene: Scene, *, knows_readout: bool = True, rows: int = 0) -> BarsAnswer:
    """Return which shutter speeds show no bars of a light, and the bars' depth at the scene's.

    Parameters
    ----------
    knows_readout
        Whether the scene's readout time is known; if so, the answer states the lines from bar to
        bar.
    rows
        Number of rows, or groups of rows, of a panel that are lit in turn, each for an equal part
        of the light's period; 0 for other lamps.
    """
    exposure, transmitter = scene.camera.exposure_time, scene.transmitter
    period = repeat_time(transmitter) if light_fractions(scene)[0] else Fraction(0)
    speeds_nearby = [
        speed for speed in speed_depths(scene)
        if 1.0 / _LARGEST_RATIO <= speed.nominal / exposure <= _LARGEST_RATIO
    ]  # fmt: skip
    sines = () if has_chips(transmitter) else _deepest_sines(scene)
    return BarsAnswer(
        lamp=describe_light(transmitter),
        exposure=exposure,
        depth=light_depth(scene).peak_to_peak,
        speeds=_choose_speeds(speeds_nearby, exposure),
        best=min(speeds_nearby, key=lambda speed: speed.at_nominal, default=None),
        valley=float(period),
        columns=_columns_per_bar(scene, sines[0][1]) if knows_readout and sines else None,
        rates=_compute_beats(sines, exposure),
        rows=unlit_rows(rows, float(1 / period), exposure) if rows and period else None,
    )


def _choose_speeds(speeds: list[SpeedDepth], exposure: float) -> tuple[SpeedDepth, ...]:
    """Return the nearest speeds without bars: before others those that show none on any camera."""
    without_bars = [speed for speed in speeds if speed.at_nominal < NO_BARS_DEPTH]
    without_bars.sort(
        key=lambda speed: (not speed.is_free, abs(math.log(speed.nominal / exposure)))
    )
    return tuple(sorted(without_bars[:_MOST_SPEEDS], key=lambda speed: -speed.nominal))


def _deepest_sines(scene: Scene) -> tuple[tuple[float, Fraction], ...]:
    """Return depth and frequency in Hz of the sines with visible bars, deepest first."""
    sines = sines_of(scene.transmitter, _SINES_PER_PIECE)
    amplitudes = sines.in_exposure(Fraction(scene.camera.exposure_time))
    depths = 2.0 * light_fractions(scene)[0] * amplitudes
    return tuple(
        (float(depths[place]), sines.base * int(sines.orders[place]))
        for place in np.argsort(-depths, kind="stable")[:_MOST_SINES].tolist()
        if depths[place] >= NO_BARS_DEPTH
    )


def _columns_per_bar(scene: Scene, frequency: Fraction) -> float:
    """Return the columns from bar to bar, as the columns sample the light."""
    step = frequency * Fraction(scene.camera.readout_time)
    step = abs(step - round(step))
    return float(1 / step) if step else math.inf


def _compute_beats(
    sines: tuple[tuple[float, Fraction], ...], exposure: float
) -> tuple[FrameRateBeats, ...]:
    """Return how a light's bars move at the usual frame rates that the exposure allows.

    From frame to frame a sine of frequency F advances by F / R cycles at the rate R, of which only
    the fraction shows: its bars return to a place |F - R round(F / R)| times a second.
    """

    def beats_at(rate: Fraction) -> tuple[Beat, ...]:
        return tuple(
            Beat(depth, float(abs(frequency - rate * round(frequency / rate))))
            for depth, frequency in sines
        )

    return tuple(
        FrameRateBeats(name, float(rate), beats_at(rate))
        for name, rate in FRAME_RATES.items()
        if sines and Fraction(exposure) * rate <= 1
    )


def unlit_rows(rows: int, frequency: float, exposure: float) -> UnlitRows:
    """Return the fractions of the rows of a panel, lit in turn, that are dark or cut short.

    Each of n rows is lit for 1 / n of a cycle, one after the other. An exposure of a fraction of a
    cycle, w rows long, lights w + 1 of them on average over its starts, of which the first and the
    last are cut short; further whole cycles light all. This holds for a shutter that opens for all
    lines at once, and on average for one that reads line by line.

    Parameters
    ----------
    rows
        n, from 1 on.
    frequency
        Cycles a second, above 0, in Hz.
    exposure
        Above 0, in seconds.

    Raises
    ------
    ParameterError
        An argument is out of range.
    """
    ROWS.check(rows)
    for name, value in (("frequency", frequency), ("exposure", exposure)):
        if not 0.0 < value < math.inf:
            raise ParameterError.of(name, quote(value), "above 0")
    cycles = Fraction(frequency) * Fraction(exposure)
    lit = (cycles % 1) * rows  # rows long
    dark, fully_lit = max(Fraction(0), rows - 1 - lit) / rows, max(Fraction(0), lit - 1) / rows
    cuts = min(lit, rows - lit) > _ROUNDING_ROWS
    return UnlitRows(
        float(dark) if cycles < 1 else 0.0, float(1 - dark - fully_lit) if cuts else 0.0
    )

"""Bars answered in one line: which shutter speeds show none of a lamp's bars, and which films."""

import math
from fractions import Fraction

import numpy as np

from occ_model.errors import ParameterError, shown
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

_NEAR = 32.0  # farthest ratio of a shutter speed that is advised to that asked about
_MOST_SPEEDS = 2
_SINES_PER_PIECE = 4
_MOST_SINES = 5


def bars_answer(scene: Scene, *, knows_readout: bool = True, rows: int = 0) -> BarsAnswer:
    """Return which shutter speeds show no bars of a light, and how deep they are at the scene's.

    Parameters
    ----------
    knows_readout
        Whether the scene's readout time is known: the answer then has the lines from bar to bar.
    rows
        How many rows, or groups of rows, of a panel are lit in turn, each for an equal part of the
        light's period; 0 for other lamps.
    """
    exposure, sent = scene.camera.exposure_time, scene.transmitter
    period = repeat_time(sent) if light_fractions(scene)[0] else Fraction(0)
    near = [each for each in speed_depths(scene) if 1.0 / _NEAR <= each.nominal / exposure <= _NEAR]
    sines = () if has_chips(sent) else _deepest_sines(scene)
    return BarsAnswer(
        lamp=describe_light(sent),
        exposure=exposure,
        depth=light_depth(scene).peak_to_peak,
        speeds=_advised(near, exposure),
        best=min(near, key=lambda each: each.at_nominal, default=None),
        valley=float(period),
        columns=_columns_of(scene, sines[0][1]) if knows_readout and sines else None,
        rates=_beats_of(sines, exposure),
        rows=unlit_rows(rows, float(1 / period), exposure) if rows and period else None,
    )


def _advised(near: list[SpeedDepth], exposure: float) -> tuple[SpeedDepth, ...]:
    """Return the nearest speeds without bars: first those that show none on any camera."""
    free = [each for each in near if each.at_nominal < NO_BARS_DEPTH]
    free.sort(key=lambda each: (not each.is_free, abs(math.log(each.nominal / exposure))))
    return tuple(sorted(free[:_MOST_SPEEDS], key=lambda each: -each.nominal))


def _deepest_sines(scene: Scene) -> tuple[tuple[float, Fraction], ...]:
    """Return depth and frequency in Hz of the sines whose bars are deep enough, deepest first."""
    sines = sines_of(scene.transmitter, _SINES_PER_PIECE)
    left = sines.in_exposure(Fraction(scene.camera.exposure_time))
    depths = 2.0 * light_fractions(scene)[0] * left
    return tuple(
        (float(depths[place]), sines.base * int(sines.orders[place]))
        for place in np.argsort(-depths, kind="stable")[:_MOST_SINES].tolist()
        if depths[place] >= NO_BARS_DEPTH
    )


def _columns_of(scene: Scene, frequency: Fraction) -> float:
    """Return the columns from bar to bar, as the columns sample the light."""
    step = frequency * Fraction(scene.camera.readout_time)
    step = abs(step - round(step))
    return float(1 / step) if step else math.inf


def frame_rate_beats(scene: Scene) -> tuple[FrameRateBeats, ...]:
    """Return what becomes of a light's bars at the usual frame rates that its exposure allows.

    From frame to frame a sine of frequency F moves on by F / R cycles at the rate R. Whole cycles
    do not show: its bars come back |F - R round(F / R)| times a second.
    """
    return _beats_of(_deepest_sines(scene), scene.camera.exposure_time)


def _beats_of(
    sines: tuple[tuple[float, Fraction], ...], exposure: float
) -> tuple[FrameRateBeats, ...]:
    def beats(rate: Fraction) -> tuple[Beat, ...]:
        return tuple(
            Beat(depth, float(abs(sine - rate * round(sine / rate)))) for depth, sine in sines
        )

    return tuple(
        FrameRateBeats(name, float(rate), beats(rate))
        for name, rate in FRAME_RATES.items()
        if sines and Fraction(exposure) * rate <= 1
    )


def unlit_rows(rows: int, frequency: float, exposure: float) -> UnlitRows:
    """Return which rows of a panel lit row by row one exposure leaves dark, and which it cuts.

    Each of n rows is lit for 1 / n of a cycle, one after the other. An exposure of a fraction of a
    cycle, w rows long, lights w + 1 of them on average over its starts, of which it cuts the first
    and the last; further whole cycles light all. This holds for a shutter that opens for all lines
    at once, and on average for one that reads line by line.

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
            raise ParameterError.of(name, shown(value), "above 0")
    cycles = Fraction(frequency) * Fraction(exposure)
    lit = (cycles % 1) * rows  # rows long
    none, whole = max(Fraction(0), rows - 1 - lit) / rows, max(Fraction(0), lit - 1) / rows
    cuts = min(lit, rows - lit) > _ROUNDING_ROWS
    return UnlitRows(float(none) if cycles < 1 else 0.0, float(1 - none - whole) if cuts else 0.0)

"""The light over time: along the columns of the picture, and during some exposures."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.exposure import on_time
from occ_model.errors import ParameterError, quote
from occ_model.light.cosine import Cosine
from occ_model.light.sent import Light, PiecewiseLight, light_of, light_period
from occ_model.light.waveform import Waveform
from occ_model.results.teaching import ExposureWindow, LightCurve, RollingShutter
from occ_model.scene.argument_checks import check_count
from occ_model.scene.scene import Scene

_RELATIVE_ERROR = 1e-12  # relative error of a ratio from writing its parts as decimals

_FEWEST_STEPS, _MOST_STEPS = 16, 256  # of a drawn cycle of a cosine


@dataclass(frozen=True, eq=False, slots=True)
class _Pieces:
    """Neighbouring pieces of a light, in seconds from a moment on."""

    edges: FloatArray  # Shape (n + 1,): start of each, and end of the last one
    levels: FloatArray  # Shape (n,)
    places: IndexArray  # Shape (n,): the index of each in the period


class _PieceTable:
    """The pieces of a light's period."""

    def __init__(self, light: PiecewiseLight) -> None:
        self.rate = light.rate  # units a second
        self._period = light.waveform.period
        self._levels = light.waveform.levels.astype(np.float64)
        self._starts = np.concatenate([[0.0], np.cumsum(light.waveform.lengths, dtype=np.float64)])

    def cut_out(
        self, moment: Fraction, before: float, after: float, most: int, *, extra: int = 0
    ) -> tuple[_Pieces, bool]:
        """Return at most ``most`` pieces about a moment, and whether there are more.

        ``before``, ``after``: seconds from the first piece to the moment, and from there to the
        last. ``extra``: further pieces on each side.
        """
        # Exact, since the moment may be any number of periods away from time zero.
        phase = float(moment * self.rate % self._period)
        first = self._piece_at(phase - before * float(self.rate)) - extra
        last = self._piece_at(phase + after * float(self.rate)) + extra
        numbers = np.arange(min(last - first + 1, most) + 1) + first
        cycles, places = np.divmod(numbers, self._period)
        starts = cycles * float(self._period) + self._starts[places]
        places = places[:-1]
        pieces = _Pieces((starts - phase) / float(self.rate), self._levels[places], places)
        return pieces, last - first + 1 > most

    def _piece_at(self, units: float) -> int:
        """Return the number of the piece at a time in units, counted from the period's first."""
        cycle = math.floor(units / self._period)
        phase = units - cycle * float(self._period)
        index = int(np.searchsorted(self._starts, phase, side="right")) - 1
        return cycle * self._period + min(max(index, 0), self._period - 1)


def _table_of(scene: Scene, seconds: float, most: int) -> _PieceTable:
    """Return a scene's light in pieces, with at most ``most`` in a number of ``seconds``.

    The pieces of a cosine are steps with its mean light.
    """
    light = light_of(scene.transmitter)
    steps = 0
    if isinstance(light, Cosine):
        steps_a_cycle = int(most / max(seconds * light.frequency, 1.0))
        steps = min(max(steps_a_cycle, _FEWEST_STEPS), _MOST_STEPS)
    return _table(light, steps)


@lru_cache(maxsize=8)
def _table(light: Light, steps: int) -> _PieceTable:
    if isinstance(light, Cosine):
        step = Fraction(1, steps) / Fraction(light.frequency)
        light = PiecewiseLight(Waveform(light.means(Fraction(0), step, steps, step)), 1 / step)
    return _PieceTable(light)


def light_over_columns(
    scene: Scene, first: float, last: float, most: int, edged: bool = False
) -> LightCurve | None:
    """Return the light along an axis of columns; None for more than ``most`` pieces, such as chips.

    The point ``i`` of the axis, which may be between columns, is the time ``t_0 + i t_r`` at which
    column ``i`` begins its exposure. With ``edged``, the light rises and falls linearly during the
    scene's edge time, from the start of a piece.
    """
    if not first < last:
        raise ParameterError.of("last", quote(last), f"above {quote(first)}, the first column")
    readout = scene.camera.readout_time
    begin = Fraction(scene.model.start_time) + Fraction(first) * Fraction(readout)
    span = (last - first) * readout
    edge = scene.transmitter.edge_time if edged else 0.0
    table = _table_of(scene, span + edge, most)
    pieces, is_cut = table.cut_out(begin, edge, span, most)
    if is_cut:
        return None
    # Earlier pieces are needed only for the light's mean over the last edge time.
    before = int(np.searchsorted(pieces.edges[1:], 0.0, side="right"))
    knots, light = _light_knots(pieces, before, edge)
    return LightCurve(
        columns=first + knots / readout,
        light=light,
        edges=first + pieces.edges[before:] / readout,
        levels=pieces.levels[before:],
        places=pieces.places[before:],
    )


def _light_knots(pieces: _Pieces, before: int, edge: float) -> tuple[FloatArray, FloatArray]:
    """Return the knots of the light after the first ``before`` pieces, and its values there."""
    starts = pieces.edges[before:]
    if edge == 0.0:
        return np.repeat(starts, 2)[1:-1], np.repeat(pieces.levels[before:], 2)
    ends = pieces.edges[:-1] + edge
    knots = np.unique(np.concatenate([starts, ends[(ends > starts[0]) & (ends < starts[-1])]]))
    integral = np.concatenate([[0.0], np.cumsum(pieces.levels * np.diff(pieces.edges))])
    integral_now, integral_earlier = (
        np.interp(knots - lag, pieces.edges, integral) for lag in (0.0, edge)
    )
    light = (integral_now - integral_earlier) / edge
    return knots, np.clip(light, 0.0, float(pieces.levels.max()))


def chips_in_exposure(scene: Scene) -> int:
    """Return n if an exposure includes parts of n or n + 1 chips, depending on its start."""
    ratio = Fraction(scene.camera.exposure_time) * Fraction(scene.transmitter.switching_frequency)
    # 100 us at 10 kHz is one chip, although no binary fraction equals 100 us.
    nearest = round(ratio)
    return nearest if math.isclose(ratio, nearest, rel_tol=_RELATIVE_ERROR) else math.ceil(ratio)


_MOST_PIECES = 400  # of a drawing


def exposure_window(scene: Scene, column: int) -> ExposureWindow:
    """Return the light during a column's exposure, with a piece before and one after."""
    check_count("column", column, 0)
    camera = scene.camera
    if column >= camera.columns:
        raise ParameterError.of(
            "column", quote(int(column)), f"0 to {camera.columns - 1}, as the picture has"
        )
    begin = Fraction(scene.model.start_time) + column * Fraction(camera.readout_time)
    exposure = camera.exposure_time
    pieces, is_cut = _table_of(scene, exposure, _MOST_PIECES - 2).cut_out(
        begin, 0.0, exposure, _MOST_PIECES, extra=1
    )
    start = -float(pieces.edges[0])
    return ExposureWindow(
        column=column,
        start=start,
        end=start + exposure,
        edges=pieces.edges + start,
        levels=pieces.levels,
        on_time=float(on_time(scene)[column]),
        shortened=is_cut,
    )


_CHIPS, _PERIODS = 4, 2  # of a code or another light, during which the columns begin


def rolling_shutter(scene: Scene, shown: int = 25) -> RollingShutter:
    """Return the exposures of up to ``shown`` columns that begin within four chips.

    For lights other than codes they begin within two periods.
    """
    camera, transmitter = scene.camera, scene.transmitter
    span = _PERIODS * float(light_period(transmitter))
    if transmitter.light == "code":
        span = _CHIPS * transmitter.switching_period
    last = min(camera.columns - 1, max(int(min(span / camera.readout_time, camera.columns)), 1))
    columns = np.unique(np.linspace(0, last, min(shown, last + 1)).round().astype(np.intp))
    starts = np.multiply(columns, camera.readout_time, dtype=np.float64)
    seconds = float(starts[-1]) + camera.exposure_time
    pieces, _ = _table_of(scene, seconds, _MOST_PIECES).cut_out(
        Fraction(scene.model.start_time), 0.0, seconds, _MOST_PIECES
    )
    return RollingShutter(
        columns=columns,
        starts=starts,
        exposure_time=camera.exposure_time,
        lit_fraction=on_time(scene)[columns] / camera.exposure_time,
        edges=pieces.edges,
        levels=pieces.levels,
    )

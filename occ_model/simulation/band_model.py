"""The band model, the state of the art with which the paper compares its simulation.

A chip has h_c = (t_LED - t) / t_r columns of one state, and a change of state h_t = t / t_r columns
of transition. The model is undefined if the exposure is longer than the switching period. For other
lights, each time L at one level has (L - t) / t_r columns.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import column_phases
from occ_model.camera.photometry import level_values, saturate
from occ_model.errors import BandModelUndefined
from occ_model.light.cosine import Cosine
from occ_model.light.sent import PiecewiseLight, light_of
from occ_model.light.times import PhasesInPeriod
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND


def band_lengths(scene: Scene) -> tuple[float, float]:
    """Return h_c and h_t, the columns of a complete band and of a transition, without rounding.

    For light without a code, h_c is that of its shortest band, infinite if it is steady.

    Raises
    ------
    BandModelUndefined
        The exposure time is longer than the switching period, or than the shortest time at one
        level, or the light has no levels, as that of a lamp on the mains.
    """
    return _Bands.of(scene).columns_of_shortest(scene)


def band_profile(scene: Scene) -> FloatArray:
    """Return the column profile that the band model predicts.

    With ``band_reading = "aligned"`` a run of n equal chips has (n t_LED - t) / t_r columns,
    without rounding, so that bands begin where they are sent and can be compared in width and
    level. With ``"literal"`` every chip has h_c and every change of state h_t columns, both rounded
    to whole columns, so that the profile drifts along the picture. Both start at the scene's start
    time. For light without a code, each time at one level is a band.

    Returns
    -------
    ndarray of float64, shape (columns,)
        Grey levels, 0 to 255.

    Raises
    ------
    BandModelUndefined
        As :func:`band_lengths`, or (if literal) a whole period rounds to no columns at all.
    """
    bands = _Bands.of(scene)
    complete, transition = bands.columns_of_shortest(scene)
    phases = bands.phases(scene)
    if bands.is_steady:
        values = np.full(len(phases.whole), bands.levels[0])
    else:
        if scene.model.band_reading == "aligned":
            exposure = float(Fraction(scene.camera.exposure_time) * bands.light.rate)
            positions, lit = bands.knots(
                np.maximum(0.0, bands.lengths - exposure), exposure, between_equal=exposure
            )
            columns: FloatArray = phases.whole + phases.fraction
        else:
            positions, lit = bands.literal_knots(scene)
            if positions[-1] == 0:
                raise BandModelUndefined(
                    "The band model is undefined here: a "
                    f"{'chip' if bands.of_chips else 'band'} of {complete + transition:.2g} "
                    "columns rounds to none."
                )
            columns = np.arange(0.5, len(phases.whole))
            columns += bands.literal_start(scene, positions)
        values = np.interp(np.mod(columns, positions[-1]), positions, lit)
    dark, bright = level_values(scene)
    return saturate(dark + (bright - dark) * values)


def band_drift(scene: Scene) -> float:
    """Return how many columns the band model is ahead of the sent light after each period.

    The literal model rounds every band, and has no columns of transition between equal chips: a run
    of n of them lasts n t_LED, but n h_c + h_t is (n - 1) t less. The result is negative if the
    model's period is longer than the sent one, and 0 for the aligned model.
    """
    bands = _Bands.of(scene)
    bands.columns_of_shortest(scene)
    if scene.model.band_reading == "aligned" or bands.is_steady:
        return 0.0
    positions, _ = bands.literal_knots(scene)
    return float(bands.light.period / Fraction(scene.camera.readout_time)) - float(positions[-1])


@dataclass(frozen=True, eq=False, slots=True)
class _Bands:
    """The bands in one period of light: one for each chip, or for each time at one level."""

    light: PiecewiseLight
    of_chips: bool
    levels: FloatArray
    exact_lengths: NDArray[Any]  # in units of the light's waveform
    start: Fraction  # start of the first band in the period, in units

    @classmethod
    def of(cls, scene: Scene) -> "_Bands":
        light = light_of(scene.transmitter)
        if isinstance(light, Cosine):
            raise BandModelUndefined(
                "The band model is undefined here: the light swings without steps, so that it has "
                "no bands of one level."
            )
        levels, lengths = light.waveform.levels, light.waveform.lengths
        start = Fraction(0)
        is_code = scene.transmitter.light == "code"
        if not is_code:
            changes = np.flatnonzero(levels != np.roll(levels, 1))
            if not changes.size:
                changes = np.array([0])
            first = int(changes[0])
            start = sum((Fraction(each) for each in lengths[:first].tolist()), start)
            levels = levels[changes]
            lengths = np.add.reduceat(np.roll(lengths, -first), changes - first)
        return cls(light, is_code, levels.astype(np.float64), lengths, start)

    @property
    def is_steady(self) -> bool:
        """Whether there is only one level; a pattern of one chip counts as bands of chips."""
        return not self.of_chips and len(self.levels) == 1

    @property
    def lengths(self) -> FloatArray:
        return self.exact_lengths.astype(np.float64)

    def columns_of_shortest(self, scene: Scene) -> tuple[float, float]:
        """Return :func:`band_lengths`."""
        exposure, readout = scene.camera.exposure_time, scene.camera.readout_time
        if self.is_steady:
            return np.inf, exposure / readout
        shortest = float(Fraction(min(self.exact_lengths.tolist())) / self.light.rate)
        if exposure > shortest:
            what = "switching period" if self.of_chips else "shortest time at one level"
            raise BandModelUndefined(
                f"The band model is undefined here: the exposure time, {SECOND.format(exposure)}, "
                f"is longer than the {what}, {SECOND.format(shortest)}."
            )
        return (shortest - exposure) / readout, exposure / readout

    def phases(self, scene: Scene, columns: int | None = None) -> PhasesInPeriod:
        """Return where in a period, counted from the first band's start, exposures start."""
        light = self.light
        return column_phases(scene, light.rate, light.waveform.period, -self.start, columns)

    def knots(
        self, complete: FloatArray, transition: float, *, between_equal: float
    ) -> tuple[FloatArray, FloatArray]:
        """Return the corners of one period's polyline: positions from 0 to its length, and levels.

        Each band has its level for its ``complete`` columns and then changes to the next one's,
        within ``transition`` columns if that differs, or ``between_equal`` columns if it does not.
        """
        moves = np.where(self.levels != np.roll(self.levels, -1), transition, between_equal)
        ends = np.cumsum(complete + moves)
        starts = np.concatenate([[0.0], ends[:-1]])
        positions = np.stack([starts, starts + complete], axis=1).ravel()
        return np.append(positions, ends[-1]), np.append(np.repeat(self.levels, 2), self.levels[0])

    def literal_knots(self, scene: Scene) -> tuple[FloatArray, FloatArray]:
        """Return the polyline of the literal model: whole columns, and none between equal chips."""
        exposure, readout = scene.camera.exposure_time, scene.camera.readout_time
        seconds = self.lengths * float(1 / self.light.rate)
        complete = np.rint((seconds - exposure) / readout)
        return self.knots(complete, round(exposure / readout), between_equal=0.0)

    def literal_start(self, scene: Scene, positions: FloatArray) -> float:
        """Return the column of the period's polyline at which the picture starts."""
        phases = self.phases(scene, columns=1)
        whole, fraction = int(phases.whole[0]), float(phases.fraction[0])
        edges = np.concatenate([[0.0], np.cumsum(self.lengths)[:-1]])
        band = int(np.searchsorted(edges, whole + fraction, side="right")) - 1
        seconds = ((whole - float(edges[band])) + fraction) * float(1 / self.light.rate)
        return float(positions[2 * band]) + round(seconds / scene.camera.readout_time)

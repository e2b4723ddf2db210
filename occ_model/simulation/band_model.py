"""The band model, the state of the art with which the paper compares its simulation.

A chip has h_c = (t_LED - t) / t_r columns of one state, and a change of state h_t = t / t_r columns
of transition. The model is undefined if the exposure is longer than the switching period.
"""

from fractions import Fraction

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import enhance
from occ_model.camera.exposure import column_phases
from occ_model.camera.photometry import level_values, saturate
from occ_model.errors import BandModelUndefined
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND
from occ_model.transmitter.scheme import sent_chips


def band_lengths(scene: Scene) -> tuple[float, float]:
    """Return h_c and h_t, the columns of a complete band and of a transition, without rounding.

    Raises
    ------
    BandModelUndefined
        The exposure time is longer than the switching period.
    """
    exposure = scene.camera.exposure_time
    period = scene.transmitter.switching_period
    if exposure > period:
        raise BandModelUndefined(
            f"The band model is undefined here: the exposure time, {SECOND.format(exposure)}, is "
            f"longer than the switching period, {SECOND.format(period)}."
        )
    readout = scene.camera.readout_time
    return (period - exposure) / readout, exposure / readout


def band_profile(scene: Scene) -> FloatArray:
    """Return the column profile that the band model predicts.

    With ``band_reading = "aligned"`` a run of n equal chips has (n t_LED - t) / t_r columns,
    without rounding, so that bands begin where they are sent and can be compared in width and
    level. With ``"literal"`` every chip has h_c and every change of state h_t columns, both rounded
    to whole columns, so that the profile drifts along the picture. Both start at the scene's start
    time.

    Returns
    -------
    ndarray of float64, shape (columns,)
        Grey levels, 0 to 255.

    Raises
    ------
    BandModelUndefined
        The exposure time is longer than the switching period, or (if literal) a whole packet rounds
        to no columns at all.
    """
    complete, transition = band_lengths(scene)
    chips = sent_chips(scene.transmitter)
    phases = column_phases(scene, Fraction(scene.transmitter.switching_frequency), len(chips))
    if scene.model.band_reading == "aligned":
        exposure = scene.camera.exposure_time * scene.transmitter.switching_frequency
        positions, lit = _knots(chips, max(0.0, 1.0 - exposure), exposure, between_equal=exposure)
        columns: FloatArray = phases.whole + phases.fraction
    else:
        positions, lit = _literal_knots(chips, complete, transition)
        if positions[-1] == 0:
            raise BandModelUndefined(
                f"The band model is undefined here: a chip of {complete + transition:.2g} columns "
                "rounds to none."
            )
        columns = np.arange(0.5, len(phases.whole))
        columns += _literal_start(scene, chips, positions)
    dark, bright = level_values(scene)
    values = np.interp(np.mod(columns, positions[-1]), positions, lit)
    return saturate(dark + (bright - dark) * values)


def band_drift(scene: Scene) -> float:
    """Return how many columns the band model is ahead of the sent packets after each packet.

    The literal model rounds every band, and has no columns of transition between equal chips: a run
    of n of them lasts n t_LED, but n h_c + h_t is (n - 1) t less. The result is negative if the
    model's packet is longer than the sent one, and 0 for the aligned model.
    """
    complete, transition = band_lengths(scene)
    if scene.model.band_reading == "aligned":
        return 0.0
    chips = sent_chips(scene.transmitter)
    positions, _ = _literal_knots(chips, complete, transition)
    return len(chips) * (complete + transition) - float(positions[-1])


def enhanced_band_profile(scene: Scene, profile: FloatArray) -> FloatArray:
    """Enhance the band model's profile as the receiver would, by the profile's own histogram."""
    return enhance(profile, scene.model.enhancement).astype(np.float64)


def _knots(
    chips: ByteArray, complete: float, transition: float, *, between_equal: float
) -> tuple[FloatArray, FloatArray]:
    """Return the corners of one packet's polyline: positions from 0 to its length, and states.

    Each chip has its state for ``complete`` columns and then changes to the next chip's, within
    ``transition`` columns if that differs, or ``between_equal`` columns if it is the same.
    """
    following = np.roll(chips, -1)
    moves = np.where(chips != following, transition, between_equal)
    ends = np.cumsum(complete + moves)
    starts = np.concatenate([[0.0], ends[:-1]])
    positions = np.stack([starts, starts + complete], axis=1).ravel()
    states = np.repeat(chips.astype(np.float64), 2)
    return np.append(positions, ends[-1]), np.append(states, states[0])


def _literal_knots(
    chips: ByteArray, complete: float, transition: float
) -> tuple[FloatArray, FloatArray]:
    """Return the polyline of the literal model: whole columns, and none between equal chips."""
    return _knots(chips, round(complete), round(transition), between_equal=0.0)


def _literal_start(scene: Scene, chips: ByteArray, positions: FloatArray) -> float:
    """Return the column of the packet's polyline at which the picture starts."""
    start = column_phases(
        scene, Fraction(scene.transmitter.switching_frequency), len(chips), columns=1
    )
    chip = int(start.whole[0])
    into_chip = float(start.fraction[0]) * scene.transmitter.switching_period
    return float(positions[2 * chip]) + round(into_chip / scene.camera.readout_time)

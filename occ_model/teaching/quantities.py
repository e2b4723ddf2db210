"""Quantities for which a lesson can ask; the model computes them from the step's scene."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from occ_model.camera.projection import panel_corners
from occ_model.errors import OccError
from occ_model.files.resources import resource_path
from occ_model.results.match import Match
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, METRE, NONE, SECOND, Unit
from occ_model.study.bands.advice import band_advice
from occ_model.study.bands.depth import band_depth
from occ_model.study.theory import band_model_frequency, null_frequency, panel_readout_time
from occ_model.transmitter.scheme import check_code, sent_chips

FRAME_RATE = 30.0  # frames a second of the film in questions about films

_BITS_A_SECOND = Unit("bit/s", ("", "k", "M"), spellings=(("bits/s", 1.0), ("bps", 1.0)))
_PERCENT = Unit("%", shown=("%", 0.01))
COLUMN = Unit("columns", spellings=(("column", 1.0), ("px", 1.0)))
_LAMP = Unit("lamps", spellings=(("lamp", 1.0),))
_CHIP = Unit("chips", spellings=(("chip", 1.0),))


@dataclass(frozen=True, slots=True)
class LessonQuantity:
    """A quantity that can be read from the window and computed by the model."""

    meaning: str
    unit: Unit
    asked_in: str  # The unit of an answer without a unit
    of_scene: Callable[[Scene], float]  # Returns the value in SI units
    of_photo: bool = False  # Whether it is computed from the scene matched to a photo
    # What a number identifies if it measures nothing: "code"; then no answer is nearly right
    identified: str = ""

    def compute(self, scene: Scene, photo: str | Match = "") -> float:
        """Return the value; ``photo`` is the name of the step's photo, or a match of another."""
        return self.of_scene(_matched_scene(scene, photo) if self.of_photo else scene)


def _threshold_limit(scene: Scene) -> float:
    # Imported here because the import takes some tenths of a second, and few steps need it.
    from occ_model.study.success_rate import check_rate
    from occ_model.study.working_range import READ_RATE, working_range

    # `limits` takes longer, as it also searches exposure times.
    settings = RateSettings(5, ("threshold",))
    check_rate(scene, settings)
    highest = working_range(scene, "switching_frequency", READ_RATE, settings).highest
    if highest is None:
        raise OccError("The threshold decoder reads this scene at no frequency.")
    return highest.value


def _matched_scene(scene: Scene, photo: str | Match) -> Scene:
    if isinstance(photo, Match):
        return photo.scene
    # Imported here because the import is slow, and few steps need it.
    from occ_model.photo.match import match_photo
    from occ_model.photo.reading.load import load_photo

    return match_photo(load_photo(resource_path("photos", f"{photo}.jpg")), scene).scene


def _chip_columns(scene: Scene) -> float:
    check_code(scene.transmitter)
    return scene.transmitter.switching_period / scene.camera.readout_time


def _code(scene: Scene) -> float:
    if scene.transmitter.light != "code" or scene.transmitter.pattern:
        raise OccError("The photo shows a lamp or a pattern, not a packet: it has no code.")
    return float(scene.transmitter.code)


def _exposure_chips(scene: Scene) -> float:
    check_code(scene.transmitter)
    return scene.camera.exposure_time * scene.transmitter.switching_frequency


def _bit_rate(scene: Scene) -> float:
    transmitter = scene.transmitter
    check_code(transmitter)
    if transmitter.pattern:
        raise OccError("A raw pattern has no bits.")
    return (
        transmitter.payload_length * transmitter.switching_frequency / len(sent_chips(transmitter))
    )


def _readout_fraction(scene: Scene) -> float:
    return min(1.0, FRAME_RATE * panel_readout_time(scene))


QUANTITIES = {  # by the name in a lesson's file
    "chip-columns": LessonQuantity(
        "columns that are read out while a chip lasts, t_LED / t_r", COLUMN, "columns",
        _chip_columns,
    ),
    "slope-columns": LessonQuantity(
        "columns of a slope between two states, t / t_r", COLUMN, "columns",
        lambda scene: scene.camera.exposure_time / scene.camera.readout_time,
    ),
    "exposure-chips": LessonQuantity(
        "chips that an exposure covers, t / t_LED", _CHIP, "chips", _exposure_chips
    ),
    "packet-columns": LessonQuantity(
        "columns of a packet", COLUMN, "columns",
        lambda scene: len(sent_chips(scene.transmitter)) * _chip_columns(scene),
    ),
    "frame-time": LessonQuantity(
        "time to read out a picture, columns times t_r", SECOND, "ms",
        lambda scene: scene.camera.columns * scene.camera.readout_time,
    ),
    "band-model-end": LessonQuantity(
        "switching frequency from which the band model is undefined, 1 / t", HERTZ, "kHz",
        band_model_frequency,
    ),
    "null-frequency": LessonQuantity(
        "switching frequency at which an alternating pattern has no stripes, 2 / t", HERTZ, "kHz",
        null_frequency,
    ),
    "second-null": LessonQuantity(
        "switching frequency of the second null, 4 / t", HERTZ, "kHz",
        lambda scene: 2.0 * null_frequency(scene),
    ),
    "band-depth": LessonQuantity(
        "depth of the bars, largest minus smallest light of a column over the mean", _PERCENT, "%",
        lambda scene: band_depth(scene).peak_to_peak,
    ),
    "barless-exposure": LessonQuantity(
        "shortest exposure time at which the bars of the code vanish", SECOND, "ms",
        lambda scene: band_advice(scene).valley,
    ),
    "lamps-named": LessonQuantity(
        "lamps that can have a code of their own, 2 to the power of the bits", _LAMP, "lamps",
        lambda scene: 2.0**scene.transmitter.bits,
    ),
    "panel-columns": LessonQuantity(
        "columns that the panel spans in the picture", COLUMN, "columns",
        lambda scene: float(np.ptp(panel_corners(scene)[:, 0])),
    ),
    "place-a-pixel": LessonQuantity(
        "distance that a camera moves to the side while the panel moves by a pixel", METRE, "mm",
        lambda scene: scene.pose.distance / scene.camera.focal_length_pixels,
    ),
    "threshold-limit": LessonQuantity(
        "highest switching frequency that the threshold decoder reads", HERTZ, "kHz",
        _threshold_limit,
    ),
    "bit-rate": LessonQuantity(
        "bits sent a second, f times the bits over the chips of a packet", _BITS_A_SECOND, "bit/s",
        _bit_rate,
    ),
    "share-seen": LessonQuantity(
        f"fraction of the time in which a film of {FRAME_RATE:g} frames a second sees the panel",
        _PERCENT, "%", _readout_fraction,
    ),
    "bit-rate-seen": LessonQuantity(
        f"bits a second that a film of {FRAME_RATE:g} frames a second sees", _BITS_A_SECOND,
        "bit/s", lambda scene: _bit_rate(scene) * _readout_fraction(scene),
    ),
    "photo-readout-time": LessonQuantity(
        "readout time of the photo's camera", SECOND, "µs",
        lambda scene: scene.camera.readout_time, of_photo=True,
    ),
    "photo-exposure-time": LessonQuantity(
        "exposure time of the photo", SECOND, "µs",
        lambda scene: scene.camera.exposure_time, of_photo=True,
    ),
    "photo-exposure-chips": LessonQuantity(
        "chips that the photo's exposure covers, t / t_LED", _CHIP, "chips", _exposure_chips,
        of_photo=True,
    ),
    "photo-code": LessonQuantity(
        "code that the photo shows", NONE, "", _code, of_photo=True, identified="code"
    ),
}  # fmt: skip


_DIGITS = 3  # significant digits; integer parts are written in full


def result_text(unit: Unit, value: float) -> str:
    _, factor = unit.display(value)
    if not unit.symbol and value == round(value):
        return f"{value:.0f}"
    before_point = len(f"{abs(value / factor):.0f}")
    return unit.format(value, max(_DIGITS, before_point))

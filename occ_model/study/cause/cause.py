"""Why a picture is not read: the cause in the scene, not the symptom in a decoder."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from occ_model.camera.photometry import FLAT_SPAN, WHITE, deviation, level_values
from occ_model.camera.projection import panel_corners
from occ_model.effects.paper_view import region_of
from occ_model.receiver.decoder import columns_of_chip
from occ_model.receiver.matched.templates import MOST_BITS
from occ_model.results.decoding import Region
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import quantity
from occ_model.scene.parameters.light import MAX_BITS
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ
from occ_model.study import theory
from occ_model.transmitter.packet import sent_chips
from occ_model.transmitter.scheme import scheme_of

TWO_HEADERS = ("threshold", "equalizer")  # need two headers; others read a single packet
_NEAR_NULL = 0.96  # fraction of the null frequency from which single chips are lost in rounding
_TARGET_LEVEL = 200.0  # grey level of the lit panel that a suggested step aims at
_LOST_AREA_RATIO = 4.0  # times the panel's area from which a rectangle is not the panel's
_STEP_MARGIN = 1.15  # factor by which a suggested step exceeds the theoretical limit


_MIN_SWING_TO_NOISE = {"threshold": 10.0, "equalizer": 2.0}
"""Minimum ratio of the stripes' swing to a column's noise, found on random scenes: a single wrong
column splits a run. The equalizer smooths."""


@dataclass(frozen=True, slots=True)
class Step:
    """A remedy: parameters to change, in SI units, or another decoder."""

    label: str
    changes: Mapping[str, ParameterValue] = field(default_factory=dict)
    decoder: str = ""


@dataclass(frozen=True, slots=True)
class Cause:
    """What is wrong, in a few words; why, in a sentence; and a remedy, if any."""

    what: str
    why: str
    step: Step | None = None


def cause_of(scene: Scene, decoder: str, region: Region | None = None) -> Cause | None:
    """Find why a decoder cannot read a scene from a region; None without a reason."""
    if scene.transmitter.pattern:
        return None
    found = (
        _light(scene), _lost_panel(scene, region), _short_chips(scene),
        _few_chips(scene, decoder), _bits(scene, decoder),
        _null(scene, decoder), _noise(scene, decoder),
    )  # fmt: skip
    return next((one for one in found if one is not None), None)


def _light(scene: Scene) -> Cause | None:
    dark, lit = level_values(scene).tolist()
    if dark >= WHITE:
        return Cause(
            "all is white", "The dark chips are as white as the lit ones.", _to_level(scene, lit)
        )
    if lit - dark < FLAT_SPAN:
        return Cause(
            "too dark",
            f"The lit panel differs from the dark one by {lit - dark:.2g} grey levels: the "
            "exposure is too short for the light.",
            _to_level(scene, lit) if lit > dark else None,
        )
    return None


def _to_level(scene: Scene, lit: float) -> Step:
    """Return the ISO speed that brings the lit panel to a level, within its range."""
    iso = quantity("iso")
    low, high = iso.slider
    wanted = scene.camera.iso * (_TARGET_LEVEL / max(lit, 1e-3)) ** scene.camera.gamma
    value = float(f"{min(max(wanted, low), high):.3g}")
    return Step(f"Set ISO {iso.format(value)}", {"iso": value})


def _lost_panel(scene: Scene, region: Region | None) -> Cause | None:
    """Compare the region that the receiver found with the panel, where that is small."""
    camera = scene.camera
    panel = region_of(panel_corners(scene), camera.rows, camera.columns)
    if region is None or panel is None or _area(region) < _LOST_AREA_RATIO * _area(panel):
        return None
    fraction, wanted = _area(panel) / (camera.rows * camera.columns), scene.receiver.bright_fraction
    if fraction >= wanted:
        return None
    value = max(float(f"{0.5 * fraction:.2g}"), quantity("bright_fraction").low)
    return Cause(
        "the panel is not found",
        f"The brightest {100.0 * wanted:.3g} % of the pixels mark it, but it covers "
        f"{100.0 * fraction:.2g} % of the picture: noise beside it is marked as well.",
        Step(f"Mark the brightest {100.0 * value:.2g} %", {"bright_fraction": value}),
    )


def _area(region: Region) -> int:
    return region.rows * region.columns


def _short_chips(scene: Scene) -> Cause | None:
    columns = columns_of_chip(scene)
    if columns >= 1.0:
        return None
    value = float(f"{theory.row_rate_frequency(scene):.3g}")
    return Cause(
        "chips are narrower than a column",
        f"A chip lasts {columns:.2g} columns: not every chip has a column of its own.",
        _frequency(value),
    )


def _few_chips(scene: Scene, decoder: str) -> Cause | None:
    length = len(sent_chips(scene.transmitter))
    packets = 2 if decoder in TWO_HEADERS else 1
    shown = theory.panel_readout_time(scene) * scene.transmitter.switching_frequency
    if shown >= packets * length:
        return None
    if not shown:
        return Cause("the panel is out of the picture", "No column shows it.")
    needed = packets * length / shown * _STEP_MARGIN
    frequency = float(f"{scene.transmitter.switching_frequency * needed:.3g}")
    exposed = frequency * scene.camera.exposure_time
    nearer = float(f"{scene.pose.distance / needed:.2g}")
    if exposed < 2.0 * _NEAR_NULL or decoder != "threshold":
        step = _frequency(frequency)
    else:
        step = Step(f"Come to {quantity('distance').format(nearer)}", {"distance": nearer})
    why = f"{int(shown)} of the {packets * length} chips of "
    why += (
        "two packets are in view, and so both headers not in every picture"
        if packets == 2
        else "a packet are in view"
    )
    return Cause("too few chips in view", f"{why}: come closer, or raise the frequency.", step)


def _frequency(value: float) -> Step:
    return Step(f"Set {HERTZ.format(value)}", {"switching_frequency": value})


def _bits(scene: Scene, decoder: str) -> Cause | None:
    bits, compared = scheme_of(scene.transmitter).bits, _compared_bits(scene)
    if decoder != "matched" or bits <= compared:
        return None
    return Cause(
        "too many bits to compare",
        f"The matched decoder compares all payloads, of up to {compared} bits; this has {bits}.",
        Step("Try the sequence decoder", decoder="sequence"),
    )


def _compared_bits(scene: Scene) -> int:
    return MAX_BITS if scheme_of(scene.transmitter).is_papers else MOST_BITS


def _null(scene: Scene, decoder: str) -> Cause | None:
    null = theory.null_frequency(scene)
    ratio = scene.transmitter.switching_frequency / null
    if decoder not in TWO_HEADERS or ratio < _NEAR_NULL:
        return None
    side = "beyond" if ratio > 1.0 else "at"
    why = f"An exposure covers {2.0 * ratio:.3g} chips: single chips average out"
    if decoder == "equalizer":
        why += ", and undoing that amplifies rounding and noise"
    return Cause(f"{side} the null at {HERTZ.format(null, 3)}", f"{why}.", _whole_packets(scene))


def _noise(scene: Scene, decoder: str) -> Cause | None:
    """Compare a column's noise with the stripes of chips that alternate."""
    chips = scene.camera.exposure_time * scene.transmitter.switching_frequency
    region = region_of(panel_corners(scene), scene.camera.rows, scene.camera.columns)
    if decoder not in _MIN_SWING_TO_NOISE or region is None or chips >= 2.0:
        return None
    values = level_values(scene)
    of_pixel = deviation(values, scene, lambda electrons: electrons + scene.sensor.read_noise**2)
    of_column = float(of_pixel.max()) / math.sqrt(region.rows)
    swing = float(values[1] - values[0]) * min(1.0, 2.0 / chips - 1.0)
    if swing >= _MIN_SWING_TO_NOISE[decoder] * of_column:
        return None
    return Cause(
        "too much noise",
        f"A column's noise is {of_column:.2g} grey levels, where stripes of single chips swing by "
        f"{swing:.2g}.",
        _whole_packets(scene),
    )


def _whole_packets(scene: Scene) -> Step:
    """Return the remedy of a decoder that compares whole packets in place of single chips."""
    other = "matched" if scheme_of(scene.transmitter).bits <= _compared_bits(scene) else "sequence"
    return Step(f"Try the {other} decoder", decoder=other)

"""Suspected causes in the light, and in the timing of chips, exposure and columns."""

import math
from collections.abc import Iterator

from occ_model.camera.photometry import (
    WHITE,
    ColumnLight,
    level_values,
    panel_values,
    saturation_value,
)
from occ_model.camera.projection import panel_corners
from occ_model.receiver.decoder import columns_of_chip, count_whole_chips
from occ_model.receiver.matched.templates import MOST_BITS
from occ_model.results.decoding import Remedy
from occ_model.scene.parameters import PARAMETERS, quantity
from occ_model.scene.parameters.light import MAX_BITS
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, PERCENT, SECOND
from occ_model.study import theory
from occ_model.study.cause.suspect import Attempt, Suspect
from occ_model.transmitter.scheme import scheme_of

_TARGET = 200.0  # grey level of the lit panel at which a remedy aims
_FULL_FRACTION = 0.8  # fraction of a full pixel's level to aim at if that is below the target
_DIM = 60.0  # grey level of the lit panel below which there may be too little light
_HIGH_DARK_LEVEL = 0.5  # relative to the lit panel's level: contrast may be low from here on


def suspect_overexposure(scene: Scene, *, full_pixels: bool) -> Suspect | None:
    """Suspect columns that are white or, with ``full_pixels``, whose pixels are full."""
    limit = saturation_value(scene) if full_pixels else WHITE
    if float(panel_values(scene, ColumnLight.of(scene)).max()) <= limit:
        return None
    dark, lit = level_values(scene).tolist()
    end = "white is 255" if limit == WHITE else f"a pixel is full at {limit:.4g}"
    why = f"The lit panel would have the level {lit:.4g}, and {end}: columns above that look alike."
    if dark >= limit:
        why = f"Even the dark panel would have the level {dark:.4g}, and {end}: it has no stripes."
    return Suspect("overexposed", why, _darken, tuple(_remedies(scene, _target_level(scene))), True)


def _target_level(scene: Scene) -> float:
    return min(_TARGET, _FULL_FRACTION * saturation_value(scene))


def _darken(attempt: Attempt) -> Attempt:
    """Lower the gain until the lit panel is below white, then the light until no pixel is full.

    A lower gain leaves the electrons and their noise unchanged.
    """
    scene, iso = attempt.scene, quantity("iso")
    gain = _light_factor(scene, _TARGET)
    value = max(scene.camera.iso * gain, iso.low)
    attempt = attempt.change(iso=value).scale_light(gain * scene.camera.iso / value)
    level = _target_level(attempt.scene)
    return attempt if level == _TARGET else attempt.scale_light(_light_factor(attempt.scene, level))


def _light_factor(scene: Scene, level: float) -> float:
    """Return the factor by which light brings the lit panel to a level."""
    lit = float(level_values(scene)[1])
    return float((level / lit) ** scene.camera.gamma)


def _remedies(scene: Scene, level: float) -> Iterator[Remedy]:
    """Yield the ISO speed and the aperture that bring the lit panel to a level within the sliders.

    Only the aperture can keep pixels from being full.
    """
    factor = _light_factor(scene, level)
    for name, value in (
        ("iso", scene.camera.iso * factor), ("f_number", scene.camera.f_number / math.sqrt(factor))
    ):  # fmt: skip
        parameter = quantity(name)
        low, high = parameter.slider
        setting = float(f"{min(max(value, low), high):.3g}")
        label = "ISO" if name == "iso" else "the f-number"
        yield Remedy(f"Set {label} {parameter.format(setting)}", {name: setting})


def suspect_darkness(scene: Scene) -> Suspect | None:
    dark, lit = level_values(scene).tolist()
    if not dark < lit < _DIM:
        return None
    return Suspect(
        "too dark",
        f"The lit panel has the level {lit:.2g}, the dark one {dark:.2g}, of 255.",
        lambda attempt: attempt.scale_light(_light_factor(attempt.scene, _TARGET)),
        tuple(_remedies(scene, _TARGET)),
    )


def suspect_other_light(scene: Scene) -> Suspect | None:
    dark, lit = level_values(scene).tolist()
    if not scene.surroundings.illuminance or dark < _HIGH_DARK_LEVEL * lit:
        return None
    return Suspect(
        "much light from other sources",
        f"The dark panel has {PERCENT.format(dark / lit, 2)} of the lit one's level.",
        lambda attempt: attempt.change(illuminance=0.0),
    )


_FEW_COLUMNS = 3.0  # columns per chip below which they may be too few
_COLUMNS_OF_A_CHIP = 5.0  # columns per chip that are certainly enough
_SHORT_EXPOSURE = 0.5  # exposure in chips that is short enough to show single chips
_NULL_RANGE = 0.1  # fraction of the null's frequency within which a scene is near it
_MARGIN = 1.15  # factor by which a remedy shows more than is needed
_MOST_COLUMNS = 20_000  # columns to which a picture is widened


def suspect_narrow_chips(scene: Scene) -> Suspect | None:
    columns = columns_of_chip(scene)
    if columns >= 1.0:
        return None
    return Suspect(
        "chips are narrower than a column",
        f"A chip lasts {columns:.2g} columns, so not every chip has a column of its own.",
        _read_out_faster,
        (_frequency_remedy(theory.row_rate_frequency(scene)),),
    )


def suspect_few_columns(scene: Scene) -> Suspect | None:
    columns = columns_of_chip(scene)
    if not 1.0 <= columns < _FEW_COLUMNS:
        return None
    return Suspect(
        f"chips of {columns:.2g} columns", f"A chip lasts {columns:.2g} columns.", _read_out_faster
    )


def _read_out_faster(attempt: Attempt) -> Attempt:
    """Read out more columns per chip, with the same number of chips in view."""
    factor = _COLUMNS_OF_A_CHIP / columns_of_chip(attempt.scene)
    return _widen(attempt.change(readout_time=attempt.scene.camera.readout_time / factor), factor)


def _widen(attempt: Attempt, factor: float) -> Attempt:
    """Widen the panel, and the picture as far as necessary, at the same pixels per metre."""
    scene = attempt.scene
    camera, corners = scene.camera, panel_corners(scene)[:, 0]
    centre, half_width = float(corners.mean()), float(corners.max() - corners.min()) / 2.0
    columns_needed = 2.0 * (abs(centre - camera.columns / 2.0) + half_width * factor)
    columns = math.ceil(max(camera.columns, min(columns_needed, camera.columns * factor)))
    if columns > _MOST_COLUMNS:
        raise PARAMETERS["columns"].refuse(f"is {columns}", f"up to {_MOST_COLUMNS}")
    # The equivalent focal length refers to the diagonal of the whole picture.
    before, after = (math.hypot(camera.rows, number) for number in (camera.columns, columns))
    return attempt.change(
        columns=columns,
        panel_width=scene.transmitter.panel_width * factor,
        equivalent_focal_length=camera.equivalent_focal_length * before / after,
    )


def _frequency_remedy(value: float) -> Remedy:
    value = float(f"{value:.3g}")
    return Remedy(f"Set {HERTZ.format(value)}", {"switching_frequency": value})


def reads_two_headers(scene: Scene, decoder: str) -> bool:
    """Return whether a decoder needs two headers of a scene's packets instead of one packet."""
    return decoder in ("threshold", "equalizer") and scheme_of(scene.transmitter).ends_by_header


def suspect_few_chips(attempt: Attempt) -> Suspect | None:
    scene = attempt.scene
    sent = scene.transmitter
    packets = 2 if reads_two_headers(scene, attempt.decoder) else 1
    needed = packets * scheme_of(sent).length
    visible = theory.panel_readout_time(scene) * sent.switching_frequency
    if visible >= needed:
        return None
    factor = needed / visible * _MARGIN
    distance = float(f"{scene.pose.distance / factor:.2g}")
    room = f"The panel's image has room for {count_whole_chips(visible)} of the {needed} chips of"
    why = f"{room} a packet."
    if packets == 2:
        why = f"{room} two packets, so not every picture shows both headers."
    return Suspect(
        "too few chips in view",
        why,
        lambda attempt: _widen(attempt, factor),
        (
            _frequency_remedy(sent.switching_frequency * factor),
            Remedy(f"Come to {quantity('distance').format(distance)}", {"distance": distance}),
        ),
    )


def exposure_in_chips(scene: Scene) -> float:
    return scene.camera.exposure_time * scene.transmitter.switching_frequency


def suspect_long_exposure(scene: Scene) -> Suspect | None:
    """Suspect an exposure that is longer than a chip."""
    sent = scene.transmitter
    chips = exposure_in_chips(scene)
    if chips <= 1.0:
        return None
    null = theory.null_frequency(scene)
    offset = sent.switching_frequency - null
    what = f"exposed for {chips:.3g} chips"
    if abs(offset) <= _NULL_RANGE * null:
        side = "above" if offset > 0.0 else "below"
        place = f"the null at {HERTZ.format(null, 3)}"
        is_at = HERTZ.format(sent.switching_frequency, 3) == HERTZ.format(null, 3)
        what = f"at {place}" if is_at else f"{HERTZ.format(abs(offset), 2)} {side} {place}"
    elif offset > 0.0:
        what = f"beyond the null at {HERTZ.format(null, 3)}"
    swing = PERCENT.format(theory.alternating_swing(scene), 2)
    short = float(f"{_SHORT_EXPOSURE * sent.switching_period:.3g}")
    return Suspect(
        what,
        f"An exposure covers {chips:.3g} chips and leaves {swing} of the swing of "
        "alternating chips.",
        _shorten_exposure,
        (*_decoder_remedies(scene), _exposure_remedy(scene, short)),
    )


def _shorten_exposure(attempt: Attempt) -> Attempt:
    """Expose for less than a chip, with proportionally more light."""
    exposure = attempt.scene.camera.exposure_time
    short = _SHORT_EXPOSURE * attempt.scene.transmitter.switching_period
    return attempt.change(exposure_time=short).scale_light(exposure / short)


def _exposure_remedy(scene: Scene, exposure: float) -> Remedy:
    """Return a remedy by exposure time that keeps the brightness as far as ISO's slider allows."""
    low, high = quantity("iso").slider
    iso = scene.camera.iso * scene.camera.exposure_time / exposure
    changes = {"exposure_time": exposure, "iso": float(f"{min(max(iso, low), high):.3g}")}
    return Remedy(f"Expose for {SECOND.format(exposure)}", changes)


def _decoder_remedies(scene: Scene) -> tuple[Remedy, ...]:
    """Return remedies by decoders that compare whole packets instead of single chips."""
    is_compared = scheme_of(scene.transmitter).bits <= count_comparable_bits(scene)
    names = ("matched", "sequence") if is_compared else ("sequence",)
    return tuple(Remedy(f"Try the {name} decoder", decoder=name) for name in names)


def count_comparable_bits(scene: Scene) -> int:
    return MAX_BITS if scheme_of(scene.transmitter).is_papers else MOST_BITS

"""List what can keep a picture from being read, and the scene without it."""

import math
from dataclasses import replace

from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import Effect
from occ_model.effects.paper_view import region_of
from occ_model.effects.registry import EFFECTS
from occ_model.results.cause import Remedy
from occ_model.scene.parameter_kinds import in_sentence
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.study import theory
from occ_model.study.cause.brightness import (
    suspect_darkness,
    suspect_other_light,
    suspect_overexposure,
)
from occ_model.study.cause.suspect import Attempt, Suspect
from occ_model.study.cause.timing import (
    compared_bits,
    exposure_in_chips,
    suspect_few_chips,
    suspect_few_columns,
    suspect_long_exposure,
    suspect_narrow_chips,
)
from occ_model.transmitter.scheme import scheme_of

_FULL_WELL = "full-well"  # name of the effect by which full pixels are overexposed
_MILD_EXPOSURE = 1.8  # exposure in chips up to which decoders usually read


def refusal_of(attempt: Attempt) -> Suspect | None:
    """Return why a decoder cannot read the scene, whatever the picture shows; None if it can."""
    scene = attempt.scene
    if not theory.panel_readout_time(scene):
        is_there = theory.is_panel_in_picture(scene)
        what = (
            "the panel is smaller than a pixel" if is_there else "the panel is out of the picture"
        )
        return Suspect(what, "No column shows it.", lambda one: one)
    bits, compared = scheme_of(scene.transmitter).bits, compared_bits(scene)
    if attempt.decoder != "matched" or bits <= compared:
        return None
    return Suspect(
        "too many bits to compare",
        f"The matched decoder compares all payloads, of up to {compared} bits; this has {bits}.",
        lambda one: replace(one, decoder="sequence"),
        (Remedy("Try the sequence decoder", decoder="sequence"),),
    )


def list_suspects(attempt: Attempt) -> list[Suspect]:
    """List what may be wrong in a scene: light first, and last what is often harmless."""
    scene = attempt.scene
    enhanced, exposed, effects = (
        _suspect_enhancement(scene),
        suspect_long_exposure(scene),
        _effects_by_name(attempt),
    )
    is_mild = exposure_in_chips(scene) < _MILD_EXPOSURE
    # These decoders are made to undo the exposure.
    undoes = attempt.decoder in ("equalizer", "sequence")
    found = [
        suspect_overexposure(scene, full_pixels=_FULL_WELL in effects), suspect_darkness(scene),
        suspect_other_light(scene), _suspect_small_panel(scene), suspect_narrow_chips(scene),
        suspect_few_chips(attempt), enhanced if undoes else None,
        None if is_mild else exposed,
        *(_suspect_effect(one) for name, one in effects.items() if name != _FULL_WELL),
        exposed if is_mild else None, suspect_few_columns(scene),
        None if undoes else enhanced,
    ]  # fmt: skip
    return [one for one in found if one is not None]


def _effects_by_name(attempt: Attempt) -> dict[str, Effect]:
    """Return the effects with which the picture is simulated, by name."""
    scene, settings = attempt.scene, attempt.settings
    is_bare = settings.tolerance == math.inf
    return {
        effect.name: effect
        for effect in EFFECTS
        if settings.force.get(effect.name, effect.is_present(scene) and not is_bare)
    }


def _suspect_effect(effect: Effect) -> Suspect:
    def switch_off(one: Attempt) -> Attempt:
        force = {**one.settings.force, effect.name: False}
        return replace(one, settings=replace(one.settings, force=force))

    return Suspect(
        in_sentence(effect.label), "Without this effect the code would be read.", switch_off
    )


def _suspect_small_panel(scene: Scene) -> Suspect | None:
    """Suspect a panel that covers less of the picture than the receiver marks."""
    camera = scene.camera
    panel = region_of(panel_corners(scene), camera.rows, camera.columns)
    if panel is None:
        return None
    fraction = panel.rows * panel.columns / (camera.rows * camera.columns)
    wanted = scene.receiver.bright_fraction
    if fraction >= wanted:
        return None
    value = max(float(f"{0.5 * fraction:.2g}"), quantity("bright_fraction").low)
    return Suspect(
        "the panel is not found",
        f"The receiver marks the brightest {PERCENT.format(wanted, 3)} of the pixels, but the "
        f"panel covers {PERCENT.format(fraction, 2)} of the picture: pixels beside it are marked "
        "as well.",
        lambda one: one.change(bright_fraction=value),
        (Remedy(f"Mark the brightest {PERCENT.format(value, 2)}", {"bright_fraction": value}),),
    )


def _suspect_enhancement(scene: Scene) -> Suspect | None:
    enhancement = scene.model.enhancement
    if enhancement == "none":
        return None
    return Suspect(
        f"enhanced by {enhancement}",
        "Enhanced levels say less about the light; without enhancement the code would be read.",
        lambda one: one.change(enhancement="none"),
        (Remedy("Turn off enhancement", {"enhancement": "none"}),),
    )

"""What can keep a picture from being read, and the scene without it."""

import math
from dataclasses import replace

from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import Effect
from occ_model.effects.paper_view import region_of
from occ_model.effects.registry import EFFECTS
from occ_model.scene.parameter_kinds import in_sentence
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study import theory
from occ_model.study.cause.brightness import darkness, other_light, overexposure
from occ_model.study.cause.suspect import Attempt, Step, Suspect
from occ_model.study.cause.timing import (
    compared_bits,
    exposure_in_chips,
    few_chips,
    few_columns,
    long_exposure,
    narrow_chips,
)
from occ_model.transmitter.scheme import scheme_of

_FULL_WELL = "full-well"  # the effect's name: a full pixel is overexposed
_MILD_EXPOSURE = 1.8  # chips up to which decoders usually read


def refusal_of(attempt: Attempt) -> Suspect | None:
    """Return what a decoder cannot read whatever the picture shows; None where there is none."""
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
        (Step("Try the sequence decoder", decoder="sequence"),),
    )


def suspected(attempt: Attempt) -> list[Suspect]:
    """List what may be wrong in a scene, the light first and what is often no fault last."""
    scene = attempt.scene
    enhanced, exposed, effects = _enhanced(scene), long_exposure(scene), _simulated(attempt)
    is_mild = exposure_in_chips(scene) < _MILD_EXPOSURE
    # To undo the exposure is what these decoders are for.
    undoes = attempt.decoder in ("equalizer", "sequence")
    found = [
        overexposure(scene, full_pixels=_FULL_WELL in effects), darkness(scene), other_light(scene),
        _small_panel(scene), narrow_chips(scene), few_chips(attempt), enhanced if undoes else None,
        None if is_mild else exposed,
        *(_effect(one) for name, one in effects.items() if name != _FULL_WELL),
        exposed if is_mild else None, few_columns(scene),
        None if undoes else enhanced,
    ]  # fmt: skip
    return [one for one in found if one is not None]


def _simulated(attempt: Attempt) -> dict[str, Effect]:
    """Return the effects that the picture is simulated with, by name."""
    scene, settings = attempt.scene, attempt.settings
    is_bare = settings.tolerance == math.inf
    return {
        effect.name: effect
        for effect in EFFECTS
        if settings.force.get(effect.name, effect.is_present(scene) and not is_bare)
    }


def _effect(effect: Effect) -> Suspect:
    def switch_off(one: Attempt) -> Attempt:
        force = {**one.settings.force, effect.name: False}
        return replace(one, settings=replace(one.settings, force=force))

    return Suspect(in_sentence(effect.label), "Without it the code would be read.", switch_off)


def _small_panel(scene: Scene) -> Suspect | None:
    """Suspect a panel that covers less of the picture than marks it for the receiver."""
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
        f"The brightest {100.0 * wanted:.3g} % of the pixels mark it, but it covers "
        f"{100.0 * fraction:.2g} % of the picture: pixels beside it are marked as well.",
        lambda one: one.changed(bright_fraction=value),
        (Step(f"Mark the brightest {100.0 * value:.2g} %", {"bright_fraction": value}),),
    )


def _enhanced(scene: Scene) -> Suspect | None:
    enhancement = scene.model.enhancement
    if enhancement == "none":
        return None
    return Suspect(
        f"enhanced by {enhancement}",
        "A level tells less of the light then: without that the code would be read.",
        lambda one: one.changed(enhancement="none"),
        (Step("Enhance nothing", {"enhancement": "none"}),),
    )

"""Find why a picture is not read: the part of the scene without which it would be read.

Each suspected cause is removed from the scene by itself, with all else unchanged, and the same
decoder reads the picture again. If removing one is enough, it is the cause; otherwise the causes
are those that must be removed together. If removing all of them does not help, no cause is stated.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import Effect, region_of
from occ_model.effects.plan import signal_plan
from occ_model.effects.registry import EFFECTS
from occ_model.errors import OccError, ParameterError
from occ_model.parallel.job import Heartbeat
from occ_model.receiver.decode import DECODERS
from occ_model.results.decoding import Cause, Remedy
from occ_model.results.sweep_request import SignalPath
from occ_model.scene.declaration import in_sentence
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.scene.units import PERCENT
from occ_model.study import theory
from occ_model.study.cause.suspect import Attempt, Suspect
from occ_model.study.cause.suspects import (
    count_comparable_bits,
    exposure_in_chips,
    suspect_darkness,
    suspect_few_chips,
    suspect_few_columns,
    suspect_long_exposure,
    suspect_narrow_chips,
    suspect_other_light,
    suspect_overexposure,
)
from occ_model.study.signals.pictures import observe_images, picture_itself
from occ_model.transmitter.scheme import check_code, scheme_of


def cause_of(
    scene: Scene,
    decoder: str,
    settings: SimulationSettings | None = None,
    heartbeat: Heartbeat = lambda: None,
) -> Cause | None:
    """Find why a decoder does not read a scene's picture; None if it does, or no cause is found.

    No cause is sought for raw patterns, plug-ins and pictures of very many columns.
    ``heartbeat``: called before each reading. Raises ProjectionError if the scene has no picture.
    """
    is_searched = decoder in DECODERS and scene.camera.columns <= _MOST_COLUMNS
    if scene.transmitter.pattern or not is_searched:
        return None
    search = _CauseSearch(Attempt(scene, decoder, settings or SimulationSettings()), heartbeat)
    return search.find()


_MOST_COLUMNS = 100_000  # columns of a picture: with more, each of many readings takes seconds
_MOST_PIXELS = 40_000_000  # pixels of a picture to be simulated as a whole
_DRAWS = 3  # draws of the noise, with one of which the picture must not be read


class _CauseSearch:
    def __init__(self, attempt: Attempt, heartbeat: Heartbeat) -> None:
        self._attempt, self._heartbeat = attempt, heartbeat
        self._path: SignalPath = "auto"

    def find(self) -> Cause | None:
        refusal = _find_refusal(self._attempt)
        if refusal is not None:
            return self._state_cause([refusal])
        if not self._is_unread():
            return None
        suspects = list_suspects(self._attempt)
        sufficient = next(
            (suspect for suspect in suspects if self._is_read_without([suspect])), None
        )
        if sufficient is not None:
            return self._state_cause([sufficient])
        return (
            self._state_cause(self._find_needed(suspects))
            if self._is_read_without(suspects)
            else None
        )

    def _is_unread(self) -> bool:
        """Look for noise with which the picture is not read, if necessary in whole pictures."""
        settings = self._attempt.settings
        camera = self._attempt.scene.camera
        is_small = camera.rows * camera.columns <= _MOST_PIXELS
        paths: tuple[SignalPath, ...] = ("auto", "image") if is_small else ("auto",)
        for self._path in paths:
            for seed in range(settings.seed, settings.seed + _DRAWS):
                self._attempt = replace(self._attempt, settings=replace(settings, seed=seed))
                if not self._is_read(self._attempt):
                    return True
        return False

    def _find_needed(self, suspects: Sequence[Suspect]) -> list[Suspect]:
        """Return the suspects that must be removed together, dropping the last ones first."""
        needed = list(suspects)
        for suspect in reversed(suspects):
            others = [candidate for candidate in needed if candidate is not suspect]
            if others and self._is_read_without(others):
                needed = others
        return needed

    def _state_cause(self, needed: Sequence[Suspect]) -> Cause:
        first, *others = needed
        why = first.why
        if others:
            why += f" In addition: {', '.join(suspect.what for suspect in others)}."
        attempt = self._remove(others)
        helps = (each for each in first.remedies if attempt and self._is_read(attempt.apply(each)))
        return Cause(first.what, why, next(helps, None), first.is_overexposed)

    def _is_read_without(self, suspects: Sequence[Suspect]) -> bool:
        attempt = self._remove(suspects)
        return attempt is not None and self._is_read(attempt)

    def _remove(self, suspects: Sequence[Suspect]) -> Attempt | None:
        """Remove some suspects from the scene; None if a parameter's range does not allow it."""
        attempt = self._attempt
        try:
            for suspect in suspects:
                attempt = suspect.remove(attempt)
        except OccError:
            return None
        return attempt

    def _is_read(self, attempt: Attempt | None) -> bool:
        """Return whether the decoder reads all bits of the picture."""
        if attempt is None:
            return False
        self._heartbeat()
        scene, settings = attempt.scene, attempt.settings
        try:
            plan = signal_plan([scene], settings, is_estimated=self._path == "image")
            image = picture_itself(scene, plan, settings.seed)
            (observation,) = observe_images([image], self._path)
        except OccError:
            return False
        if observation is None:
            return False
        result = observation.read(scene, attempt.decoder)
        sent = np.array(scene.transmitter.payload_bits, dtype=np.uint8)
        return result.failure is None and bool(np.array_equal(result.bits, sent))


_FULL_WELL = "full-well"  # name of the effect that limits the electrons of a pixel
_MILD_EXPOSURE = 1.8  # exposure in chips up to which decoders usually read


def _find_refusal(attempt: Attempt) -> Suspect | None:
    """Return what prevents reading whatever the picture shows; None if nothing does."""
    scene = attempt.scene
    try:
        check_code(scene.transmitter)
    except ParameterError as refusal:
        remedy = Remedy("Send a code", {"light": "code"})
        return Suspect("no code is sent", str(refusal), lambda other: other, (remedy,))
    if not theory.panel_readout_time(scene):
        is_in_picture = theory.is_panel_in_picture(scene)
        what = (
            "the panel is smaller than a pixel"
            if is_in_picture
            else "the panel is out of the picture"
        )
        return Suspect(what, "No column shows it.", lambda other: other)
    bits, comparable = scheme_of(scene.transmitter).bits, count_comparable_bits(scene)
    if attempt.decoder != "matched" or bits <= comparable:
        return None
    return Suspect(
        "too many bits to compare",
        f"The matched decoder compares all payloads, of up to {comparable} bits; this has {bits}.",
        lambda other: replace(other, decoder="sequence"),
        (Remedy("Try the sequence decoder", decoder="sequence"),),
    )


def list_suspects(attempt: Attempt) -> list[Suspect]:
    """List what may be wrong in a scene: first the light, last what is often harmless."""
    scene = attempt.scene
    enhancement, exposure, effects = (
        _suspect_enhancement(scene),
        suspect_long_exposure(scene),
        _effects_by_name(attempt),
    )
    is_mild = exposure_in_chips(scene) < _MILD_EXPOSURE
    # These decoders are designed to undo the exposure.
    undoes_exposure = attempt.decoder in ("equalizer", "sequence")
    suspects = [
        suspect_overexposure(scene, full_pixels=_FULL_WELL in effects), suspect_darkness(scene),
        suspect_other_light(scene), _suspect_small_panel(scene), suspect_narrow_chips(scene),
        suspect_few_chips(attempt), enhancement if undoes_exposure else None,
        None if is_mild else exposure,
        *(_suspect_effect(effect) for name, effect in effects.items() if name != _FULL_WELL),
        exposure if is_mild else None, suspect_few_columns(scene),
        None if undoes_exposure else enhancement,
    ]  # fmt: skip
    return [suspect for suspect in suspects if suspect is not None]


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
    def switch_off(attempt: Attempt) -> Attempt:
        force = {**attempt.settings.force, effect.name: False}
        return replace(attempt, settings=replace(attempt.settings, force=force))

    return Suspect(
        in_sentence(effect.label), "Without this effect the code would be read.", switch_off
    )


def _suspect_small_panel(scene: Scene) -> Suspect | None:
    """Suspect a panel that covers less of the picture than the receiver marks as bright."""
    camera = scene.camera
    panel = region_of(panel_corners(scene), camera.rows, camera.columns)
    if panel is None:
        return None
    fraction = panel.rows * panel.columns / (camera.rows * camera.columns)
    marked = scene.receiver.bright_fraction
    if fraction >= marked:
        return None
    value = max(float(f"{0.5 * fraction:.2g}"), quantity("bright_fraction").low)
    return Suspect(
        "the panel is not found",
        f"The receiver marks the brightest {PERCENT.format(marked, 3)} of the pixels, but the "
        f"panel covers {PERCENT.format(fraction, 2)} of the picture: pixels beside it are marked "
        "as well.",
        lambda attempt: attempt.change(bright_fraction=value),
        (Remedy(f"Mark the brightest {PERCENT.format(value, 2)}", {"bright_fraction": value}),),
    )


def _suspect_enhancement(scene: Scene) -> Suspect | None:
    enhancement = scene.model.enhancement
    if enhancement == "none":
        return None
    return Suspect(
        f"enhanced by {enhancement}",
        "Enhanced levels say less about the light; without enhancement the code would be read.",
        lambda attempt: attempt.change(enhancement="none"),
        (Remedy("Turn off enhancement", {"enhancement": "none"}),),
    )

"""Why a picture is not read: that in the scene without which it would be read.

Each suspect is taken out of the scene by itself, all else left as it is, and the picture is read
again by the same decoder. One that is enough by itself is the cause; where none is, those are that
are needed together. Where nothing that is taken out makes it readable, no cause is stated.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.effects.paper_view import paper_view_of
from occ_model.effects.plan import signal_plan
from occ_model.errors import OccError
from occ_model.parallel.job import Heartbeat
from occ_model.receiver.decoders import DECODERS
from occ_model.results.sweep_request import SignalPath
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.study.cause.suspect import Attempt, Step, Suspect
from occ_model.study.cause.suspects import refusal_of, suspected
from occ_model.study.observation import observe, panel_span


@dataclass(frozen=True, slots=True)
class Cause:
    """What is wrong, in a few words; why, in a sentence; and a remedy, if any."""

    what: str
    why: str
    step: Step | None = None
    is_overexposed: bool = False

    def __str__(self) -> str:
        return f"{self.what[:1].upper()}{self.what[1:]}. {self.why}"


_SYMPTOM_END = re.compile(r"[:;.](?= |$)")


def symptom(failure: str) -> str:
    """Return the start of a failure, without what it might come from and what might help."""
    first = _SYMPTOM_END.split(failure, maxsplit=1)[0]
    return f"{first}." if first else ""


def cause_of(
    scene: Scene,
    decoder: str,
    settings: SimulationSettings | None = None,
    heartbeat: Heartbeat = lambda: None,
) -> Cause | None:
    """Find why a decoder does not read a scene's picture; None where it reads it, or none is found.

    A raw pattern has none, and for plug-ins and pictures of very many columns it is not searched.
    ``heartbeat``: called before each reading. Raises ProjectionError: the scene has no picture.
    """
    is_searched = decoder in DECODERS and scene.camera.columns <= _MOST_COLUMNS
    if scene.transmitter.pattern or not is_searched:
        return None
    search = _Search(Attempt(scene, decoder, settings or SimulationSettings()), heartbeat)
    return search.cause()


_MOST_COLUMNS = 100_000  # of a picture: one of more takes seconds to read, many times
_MOST_PIXELS = 40_000_000  # of a picture that is simulated as a whole
_DRAWS = 3  # of the noise, one of which must leave the picture unread


class _Search:
    def __init__(self, attempt: Attempt, heartbeat: Heartbeat) -> None:
        self._attempt, self._heartbeat = attempt, heartbeat
        self._path: SignalPath = "auto"

    def cause(self) -> Cause | None:
        refusal = refusal_of(self._attempt)
        if refusal is not None:
            return self._cause([refusal])
        if not self._is_unread():
            return None
        suspects = suspected(self._attempt)
        alone = next((one for one in suspects if self._reads_without([one])), None)
        if alone is not None:
            return self._cause([alone])
        return self._cause(self._needed(suspects)) if self._reads_without(suspects) else None

    def _is_unread(self) -> bool:
        """Look for noise with which the picture is not read; in doubt whole pictures tell."""
        settings = self._attempt.settings
        camera = self._attempt.scene.camera
        is_small = camera.rows * camera.columns <= _MOST_PIXELS
        paths: tuple[SignalPath, ...] = ("auto", "image") if is_small else ("auto",)
        for self._path in paths:
            for seed in range(settings.seed, settings.seed + _DRAWS):
                self._attempt = replace(self._attempt, settings=replace(settings, seed=seed))
                if not self._reads(self._attempt):
                    return True
        return False

    def _needed(self, suspects: Sequence[Suspect]) -> list[Suspect]:
        """Return those of several suspects that are all needed, the last left out first."""
        needed = list(suspects)
        for one in reversed(suspects):
            rest = [other for other in needed if other is not one]
            if rest and self._reads_without(rest):
                needed = rest
        return needed

    def _cause(self, needed: Sequence[Suspect]) -> Cause:
        first, *others = needed
        why = first.why
        if others:
            why += f" Beside that: {', '.join(one.what for one in others)}."
        rest = self._without(others)
        step = next((s for s in first.steps if rest and self._reads(s.taken(rest))), None)
        return Cause(first.what, why, step, first.is_overexposed)

    def _reads_without(self, suspects: Sequence[Suspect]) -> bool:
        attempt = self._without(suspects)
        return attempt is not None and self._reads(attempt)

    def _without(self, suspects: Sequence[Suspect]) -> Attempt | None:
        """Take some suspects out of the scene; None where a parameter's range does not allow it."""
        attempt = self._attempt
        try:
            for suspect in suspects:
                attempt = suspect.take_out(attempt)
        except OccError:
            return None
        return attempt

    def _reads(self, attempt: Attempt | None) -> bool:
        """Return whether the decoder reads all bits of the picture."""
        if attempt is None:
            return False
        self._heartbeat()
        scene, settings = attempt.scene, attempt.settings
        try:
            span = panel_span(scene)
            plan = signal_plan([scene], settings, needs_pixels=span is None)
            random = np.random.default_rng(settings.seed)
            if self._path == "image":
                span = None
            seen = observe(paper_view_of(scene), span, plan, random, self._path)
        except OccError:
            return False
        if seen is None:
            return False
        result = seen.read(scene, attempt.decoder)
        sent = np.array(scene.transmitter.payload_bits, dtype=np.uint8)
        return result.failure is None and bool(np.array_equal(result.bits, sent))

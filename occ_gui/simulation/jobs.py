"""Jobs of the simulation: read a scene by its profile, simulate its draft and its picture."""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

import occ_model as occ
from occ_gui.simulation.moves import MoveTime
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_gui.simulation.verdict import failed_decoders
from occ_gui.values.simulated import LEAST_DRAFT_STEP, SimulationRequest
from occ_model.camera.enhancement import enhance
from occ_model.effects.plan import name_effects_for_signal
from occ_model.errors import OccError, PluginError
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of, period_columns
from occ_model.parallel.job import Heartbeat
from occ_model.receiver.decode import QUICK_DECODERS, decoder_named, read_with
from occ_model.results.decoding import DecodeResult
from occ_model.results.frame import Frame
from occ_model.scene.light_words import has_chips
from occ_model.scene.scene import Scene
from occ_model.simulation.band_model import band_drift
from occ_model.simulation.render import PlannedScene, overexposed_fraction, plan_scene, render_with
from occ_model.study.bands.depth import band_depth
from occ_model.study.cause.cause import cause_of
from occ_model.study.observation import ProfileReading, read_profile

LONGEST_DRAFT = 0.016
"""Most seconds for a draft and its reading; the window needs as long to show them."""

MOST_THINNING = 4  # most rows of the screen that a row of a draft fills

LEAST_ROWS = 64  # fewest rows of a thinned draft; fewer would show too little and save no time

_SPEED_MARGIN = 3.0
"""Factor by which a thinned draft must beat its time limit before its rows are doubled.

It exceeds 2, because thinning at most halves the time: the number of rows cannot alternate.
"""


class DraftRows:
    """Chooses which rows of a picture its draft has.

    Each row of a draft fills one row of the screen, or 2 or 4 if drafts are late. A single late
    draft changes nothing, because the machine may have been busy.
    """

    def __init__(self) -> None:
        self._thinning = 1
        self._seconds: deque[float] = deque(maxlen=2)

    def choose_step(self, rows: int, rows_per_pixel: float) -> int:
        """Return how many rows of the picture each row of the draft stands for.

        ``rows_per_pixel``: rows of the picture that fall on a pixel of the screen.
        """
        finest = max(LEAST_DRAFT_STEP, int(rows_per_pixel))
        return min(max(finest, min(finest * self._thinning, rows // LEAST_ROWS)), rows)

    def record_time(self, seconds: float) -> None:
        """Record the duration of the last draft and its reading."""
        self._seconds.append(seconds)
        if len(self._seconds) < 2:
            return
        if min(self._seconds) > LONGEST_DRAFT and self._thinning < MOST_THINNING:
            self._set_thinning(2 * self._thinning)
        elif max(self._seconds) < LONGEST_DRAFT / _SPEED_MARGIN and self._thinning > 1:
            self._set_thinning(self._thinning // 2)

    def _set_thinning(self, thinning: int) -> None:
        self._thinning = thinning
        self._seconds.clear()


SMALL_PICTURE = 1_000_000  # most pixels of a picture that needs no draft, whatever its effects


_FEW_PIECES = 64  # most pieces of a light whose bars are computed while a slider moves


def reading_by_profile(
    request: SimulationRequest, planned: PlannedScene | None = None
) -> Reading | None:
    """Read a scene without its picture; None if the reading needs pixels."""
    decoders: tuple[str, ...] = ()
    if request.scene.transmitter.light == "code":
        decoders = (*QUICK_DECODERS, *filter(_is_usable, request.more_decoders))
    profile = read_profile(request.scene, request.settings, decoders)
    if profile is None:
        return None
    error = 0.0 if planned is None else planned.plan.error
    fields = _common_fields(request, request.scene, profile, profile.results)
    return Reading(source="profile", error=error, **fields)


def is_fast(planned: PlannedScene) -> bool:
    """Return whether a picture takes only milliseconds, because its rows are copies of one."""
    return planned.plan.kinds <= {"column"}


def draft_of(request: SimulationRequest, planned: PlannedScene) -> Frame | None:
    """Simulate some rows of a picture; None if the whole one is as fast."""
    camera = request.scene.camera
    if camera.rows * camera.columns <= SMALL_PICTURE or is_fast(planned):
        return None
    return render_with(request.scene, request.settings, request.draft_step, planned=planned)


def reading_of_draft(request: SimulationRequest, frame: Frame) -> Reading:
    """Read a draft of a picture, with rows counted in the whole one."""
    scene = frame.scene
    draft_results = _decode_with_all(frame, request.more_decoders)
    results = {name: _scale_rows(result, frame) for name, result in draft_results.items()}
    fields = _common_fields(request, scene, frame, results)
    return Reading(source="draft", error=frame.plan.error, **fields)


@dataclass(frozen=True, eq=False, slots=True)
class BegunMove:
    """A move until its draft: the plan, and what can be shown of it so far."""

    planned: PlannedScene
    reading: Reading | None
    draft: Frame | None
    draft_seconds: float


def begin_move(request: SimulationRequest) -> BegunMove:
    """Plan a scene, read it by its profile, and simulate and read a draft if that is needed."""
    start = perf_counter()
    planned = plan_scene(request.scene, request.settings)  # once for all that follows
    reading = reading_by_profile(request, planned)
    draft = draft_of(request, planned)
    if draft is not None:
        reading = reading or reading_of_draft(request, draft)
    return BegunMove(planned, reading, draft, perf_counter() - start)


def _scale_rows(result: DecodeResult, draft: Frame) -> DecodeResult:
    """Return a draft's result with its region in the rows of the picture, and no location."""
    region, step = result.region, draft.rows_step
    if region is not None:
        last = min(region.last_row * step, draft.scene.camera.rows)
        region = replace(region, first_row=region.first_row * step, last_row=last)
    return replace(result, region=region, location=None)


def snapshot_of(request: SimulationRequest, frame: Frame) -> Snapshot:
    scene = frame.scene
    start = perf_counter()
    results = _decode_with_all(frame, request.more_decoders)
    seconds = perf_counter() - start
    fields = _common_fields(request, scene, frame, results)
    if fields["bars"] is None and not has_chips(scene.transmitter):
        fields["bars"] = band_depth(scene)
    return Snapshot(
        source="picture",
        missing_effects=name_effects_for_signal(frame.plan, scene),
        has_picture=True,
        error=frame.plan.error,
        frame=frame,
        reading_seconds=seconds,
        **fields,
    )


def time_move(request: SimulationRequest, *, with_draft: bool) -> list[MoveTime]:
    """Simulate a scene as after a slider's move, and time it."""
    times = []
    planned = None
    if with_draft:
        move = begin_move(request)
        planned = move.planned
        if move.draft is not None:
            times.append(MoveTime.of(move.draft, move.draft_seconds))
    frame = render_with(request.scene, request.settings, planned=planned)
    snapshot_of(request, frame)  # which may need the receiver's picture, too
    return [*times, MoveTime.of(frame)]


def explain_failures(snapshot: Snapshot, heartbeat: Heartbeat = lambda: None) -> Snapshot:
    """Find why decoders have not read a picture, which may take as long as several pictures."""
    request = snapshot.request
    scene, settings = request.scene, request.settings
    causes = {}
    for name in failed_decoders(snapshot):
        if (cause := cause_of(scene, name, settings, heartbeat)) is not None:
            causes[name] = cause
    return replace(snapshot, causes=causes)


def _common_fields(
    request: SimulationRequest,
    scene: Scene,
    frame: Frame | ProfileReading,
    results: Mapping[str, DecodeResult],
) -> dict[str, Any]:
    """Return the fields that all readings have, among them the band model."""
    transmitter = scene.transmitter
    has_payload = transmitter.light == "code" and not transmitter.pattern
    return {
        "request": request,
        "scene": scene,
        "plan": frame.plan,
        "profile": frame.profile,
        "signal": frame.signal,
        "corners": frame.corners,
        "results": results,
        "has_edges": "led-edges" in frame.plan,
        "overexposed": overexposed_fraction(scene, frame.plan, frame.profile, frame.corners),
        "sent": transmitter.payload_bits if has_payload else (),
        "period_columns": period_columns(scene),
        "bars": band_depth(scene) if _has_few_pieces(scene) else None,
        **_band_model(scene),
    }


def _has_few_pieces(scene: Scene) -> bool:
    """Whether a light without chips has bars that are computed while a slider moves."""
    if has_chips(scene.transmitter):
        return False
    light = light_of(scene.transmitter)
    return isinstance(light, Cosine) or light.waveform.period <= _FEW_PIECES


def _band_model(scene: Scene) -> dict[str, Any]:
    try:
        band = occ.band_profile(scene)
        # As the receiver would enhance it, by the profile's own histogram.
        enhanced = enhance(band, scene.model.enhancement).astype(np.float64)
        return {"band": band, "enhanced_band": enhanced, "band_drift": band_drift(scene)}
    except OccError as error:
        if scene.transmitter.light == "code" and not isinstance(error, occ.BandModelUndefined):
            raise
        return {"band_undefined": str(error)}


def _is_usable(decoder: str) -> bool:
    """Return whether a decoder can be used; a plug-in's error is reported with the picture."""
    try:
        decoder_named(decoder)
    except PluginError:
        return False
    return True


def _decode_with_all(frame: Frame, extra_decoders: tuple[str, ...]) -> dict[str, DecodeResult]:
    """Decode a code with all decoders, from the signal that the first one has located."""
    scene = frame.scene
    if scene.transmitter.light != "code":
        return {}
    first = occ.decode(frame.image, scene)
    results = {first.decoder: first}
    for name in (*QUICK_DECODERS, *extra_decoders):
        if name not in results:
            results[name] = _decode_located(name, first, scene)
    return results


def _decode_located(name: str, first: DecodeResult, scene: Scene) -> DecodeResult:
    if first.signal is None:  # no panel found, which holds for all decoders
        return DecodeResult(name, failure=first.failure)
    try:
        result = read_with(name, first.signal, scene)
    except PluginError as error:  # it cannot be imported
        result = DecodeResult(name, failure=str(error))
    return replace(result, region=first.region, location=first.location)

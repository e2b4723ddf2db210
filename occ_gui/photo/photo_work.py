"""Background work on the open photo: stripes, chips, lamps, the match, and the comparison."""

from dataclasses import replace

import numpy as np

import occ_model as occ
from occ_gui.background.task import Report, Task
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.photo.shown_photo import Part, ShownPhoto, part_of
from occ_gui.shell.results import Results, ResultsStore, ResultUpdater
from occ_gui.simulation.snapshot import Reading
from occ_gui.values.choices import MatchChoice
from occ_gui.values.photo_results import MatchOutcome, MatchRequest, PhotoProfile, StripeSearch
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError
from occ_model.photo.comparison import compare, enhance_comparison
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import find_stripes
from occ_model.results.bands import Cure
from occ_model.results.chip_reading import ChipReading
from occ_model.results.comparison import Comparison
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match, known_value
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import cure_of

PartOfPhoto = tuple[Photo, Part]

_LEAST_SWING = 0.5  # smallest swing, in grey levels, that counts as stripes


def _part(workspace: Workspace, results: Results) -> PartOfPhoto | None:
    photo = results.photo
    return None if photo is None else (photo, part_of(workspace.photo, results))


def make_stripe_updater(
    store: Store, results_store: ResultsStore
) -> ResultUpdater[PartOfPhoto, StripeSearch]:
    """Make the updater that finds the stripes of a photo or a part of it."""

    def search(part: PartOfPhoto, _report: Report) -> StripeSearch:
        try:
            return StripeSearch(find_stripes(*part), "")
        except MatchError as error:
            return StripeSearch(None, str(error))

    def put(results: Results, stripes: StripeSearch | None) -> Results:
        return replace(results, stripes=stripes)

    task: Task[PartOfPhoto, StripeSearch] = Task(search, "search for stripes", impatient=True)
    work = ResultUpdater(store, results_store, task, _part, put)
    work.failed.connect(
        lambda why: results_store.put(put(results_store.results, StripeSearch(None, why)))
    )
    return work


def make_chip_updater(
    store: Store, results_store: ResultsStore
) -> ResultUpdater[PartOfPhoto, ChipReading | None]:
    """Make the updater that reads the chips of a photo or a part of it."""

    def read(part: PartOfPhoto, _report: Report) -> ChipReading | None:
        try:
            return occ.read_chips(*part)
        except MatchError:
            return None

    def put(results: Results, chips: ChipReading | None) -> Results:
        return replace(results, chips=chips)

    task: Task[PartOfPhoto, ChipReading | None] = Task(read, "reading of chips", impatient=True)
    return ResultUpdater(store, results_store, task, _part, put)


def find_lamps(photo: Photo, report: Report) -> tuple[Lamp, ...]:
    return occ.find_lamps(photo, report)  # imports its modules only now


def match(request: MatchRequest, report: Report) -> MatchOutcome:
    report(0.0)
    choice = request.choice
    scene, sent = put_known_values(request.scene, choice)
    outcome = MatchOutcome(request.part, None, known_value(choice.estimate, request.scene))
    try:
        match = occ.match_photo(  # imports its modules only now, so that the window starts sooner
            request.photo,
            scene,
            estimate=choice.estimate,
            sent=sent,
            fit_gamma=choice.fit_gamma,
            region=request.part,
            progress=report,
        )
    except MatchError as error:
        return outcome.with_refusal(error.reasons, request.part)
    return replace(outcome, match=match)


def put_known_values(scene: Scene, choice: MatchChoice) -> tuple[Scene, str]:
    """Return the scene with the known values, and the source of the sent pattern."""
    if choice.sent != "lamp":
        return scene, choice.sent
    # The duty is unknown, and a match with "scene" would refuse any other.
    return scene.replace(light="lamp", lamp_frequency=choice.lamp_frequency, duty=0.5), "auto"


def cure_of_match(match: Match | None) -> Cure | None:
    if match is None:
        return None
    return cure_of(match.scene, match.uncertainties.get("exposure_time", 0.0))


def comparison_inputs(shown: ShownPhoto) -> tuple[object, ...]:
    """Return what a comparison depends on."""
    stripes = (shown.compared_stripes, shown.why_no_stripes)
    return (shown.photo, shown.reading, *stripes, shown.placement, shown.is_enhanced)


def photo_profile(shown: ShownPhoto) -> PhotoProfile | None:
    """Return the photo's profile, placed beside the simulated one; None unless there are both."""
    photo, reading, placement = shown.photo, shown.reading, shown.placement
    if photo is None or reading is None:
        return None
    comparison, sentence = None, shown.why_no_stripes
    try:
        comparison = _compare(shown, reading)
    except MatchError as error:
        sentence = str(error)
    if comparison is not None and float(np.ptp(comparison.simulated)) < _LEAST_SWING:
        # A photo scaled to a swing of zero would agree with it.
        comparison, sentence = None, "The simulation has no stripes to compare there."
    raw = photo.profile
    if shown.is_enhanced:
        raw = enhance(raw, reading.scene.model.enhancement).astype(np.float64)
    is_outdated = reading.scene != shown.scene
    place = placement.column, placement.scale
    return PhotoProfile(comparison, raw, *place, sentence, photo, is_outdated)


def _compare(shown: ShownPhoto, reading: Reading) -> Comparison | None:
    placement, stripes = shown.placement, shown.compared_stripes
    if stripes is None:
        return None
    first = placement.column + stripes.region.first_column * placement.scale
    swing = stripes.high - stripes.low
    comparison = compare(stripes.flattened, reading.profile, first, placement.scale, swing)
    if not shown.is_enhanced:
        return comparison
    return enhance_comparison(comparison, reading.signal, reading.scene.model.enhancement)

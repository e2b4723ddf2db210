"""Background work on the open photo: lamps, stripes, chips, the match, and a comparison."""

from dataclasses import replace

import numpy as np

import occ_model as occ
from occ_gui.background.task import Report, Task
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.photo.photo_controller import KEPT_PHOTOS
from occ_gui.photo.photo_part import Part, PhotoPart, part_of
from occ_gui.shell.results import Board, Results
from occ_gui.shell.work import Work
from occ_gui.simulation.snapshot import Reading
from occ_gui.values.photo_choice import Asked, MatchAsked, MatchChoice
from occ_gui.values.photo_results import FoundMatch, PhotoProfile, StripeSearch
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError
from occ_model.photo.comparison import compare, enhance_comparison
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import find_stripes
from occ_model.results.lamp import Lamp
from occ_model.results.match import ChipReading, Comparison, counterpart
from occ_model.scene.scene import Scene
from occ_model.scene.square_wave import blinking

PartOfPhoto = tuple[Photo, Part]

AskedOfPhoto = tuple[Photo, Asked]

MatchRequest = tuple[Photo, MatchAsked]

_LEAST_SWING = 0.5  # least swing, in grey levels, of simulated columns with stripes


def lamp_search(store: Store, board: Board) -> Work[AskedOfPhoto, tuple[Lamp, ...]]:

    def of(workspace: Workspace, results: Results) -> AskedOfPhoto | None:
        asked, opened = workspace.photo.lamps_asked, results.opened
        if asked is None or opened is None or asked.source != opened.source:
            return None
        return opened.photo, asked

    def put(results: Results, lamps: tuple[Lamp, ...] | None) -> Results:
        return replace(results, lamps=lamps or ())

    def find(request: AskedOfPhoto, report: Report) -> tuple[Lamp, ...]:
        return occ.find_lamps(request[0], report)

    task: Task[AskedOfPhoto, tuple[Lamp, ...]] = Task(find, "search for lamps", impatient=True)
    return Work(store, board, task, of, put, keep=KEPT_PHOTOS)


def _part(workspace: Workspace, results: Results) -> PartOfPhoto | None:
    photo = results.photo
    return None if photo is None else (photo, part_of(workspace.photo, results))


def stripe_search(store: Store, board: Board) -> Work[PartOfPhoto, StripeSearch]:
    """Find the stripes of a photo or a part of it; those of a match replace them."""

    def search(asked: PartOfPhoto, _report: Report) -> StripeSearch:
        try:
            return StripeSearch(find_stripes(*asked), "")
        except MatchError as error:
            return StripeSearch(None, str(error))

    def put(results: Results, found: StripeSearch | None) -> Results:
        return replace(results, stripes=found)

    task: Task[PartOfPhoto, StripeSearch] = Task(search, "search for stripes", impatient=True)
    work = Work(store, board, task, _part, put)
    work.failed.connect(lambda why: board.put(put(board.results, StripeSearch(None, why))))
    return work


def chip_reading(store: Store, board: Board) -> Work[PartOfPhoto, ChipReading | None]:

    def read(asked: PartOfPhoto, _report: Report) -> ChipReading | None:
        try:
            return occ.read_chips(*asked)
        except MatchError:
            return None

    def put(results: Results, chips: ChipReading | None) -> Results:
        return replace(results, chips=chips)

    task: Task[PartOfPhoto, ChipReading | None] = Task(read, "reading of chips", impatient=True)
    return Work(store, board, task, _part, put)


def match_work(store: Store, board: Board) -> Work[MatchRequest, FoundMatch]:

    def of(workspace: Workspace, results: Results) -> MatchRequest | None:
        asked, opened = workspace.photo.match_asked, results.opened
        if asked is None or opened is None or asked.source != opened.source:
            return None
        return opened.photo, asked

    task = Task(match, "match of the photo", impatient=True)
    return Work(store, board, task, of, _put_match, stays=True, keep=KEPT_PHOTOS)


def match(request: MatchRequest, report: Report) -> FoundMatch:
    report(0.0)
    photo, asked = request
    choice = asked.choice
    scene, sent = known_scene(asked.scene, choice)
    known = counterpart(choice.estimate)
    found = FoundMatch(photo, asked.part, None, float(asked.scene.value(known)))
    try:
        match = occ.match_photo(  # imported now: the window starts sooner without it
            photo,
            scene,
            estimate=choice.estimate,
            sent=sent,
            fit_gamma=choice.fit_gamma,
            region=asked.part,
            progress=report,
        )
    except MatchError as error:
        return replace(found, refusal=error.reasons)
    return replace(found, match=match)


def _put_match(results: Results, found: FoundMatch | None) -> Results:
    """Store a match; where it is refused, the last one of the photo stays."""
    last = results.match
    if found is not None and found.refusal and last is not None and last.photo is found.photo:
        found = replace(last, refusal=found.refusal, refused_part=found.part)
    return replace(results, match=found)


def known_scene(scene: Scene, choice: MatchChoice) -> tuple[Scene, str]:
    """Return the scene with the known values, and the source of the sent pattern."""
    if choice.sent != "square":
        return scene, choice.sent
    # A lamp that is dimmed by the width of its pulses blinks too: "scene" would refuse it.
    return blinking(scene, choice.square_frequency), "auto"


def compared(part: PhotoPart) -> tuple[object, ...]:
    """Return what a comparison depends on."""
    found = (part.compared_stripes, part.why_no_stripes)
    return (part.photo, part.reading, *found, part.placement, part.is_enhanced)


def photo_profile(part: PhotoPart) -> PhotoProfile | None:
    """Place the photo's profile beside the simulated one; None where there are not both."""
    photo, reading, placement = part.photo, part.reading, part.placement
    if photo is None or reading is None:
        return None
    comparison, sentence = None, part.why_no_stripes
    try:
        comparison = _compare(part, reading)
    except MatchError as error:
        sentence = str(error)
    if comparison is not None and float(np.ptp(comparison.simulated)) < _LEAST_SWING:
        # A photo scaled to no swing at all would agree with any simulation.
        comparison, sentence = None, "The simulation has no stripes there to compare."
    raw = photo.profile
    if part.is_enhanced:
        raw = enhance(raw, reading.scene.model.enhancement).astype(np.float64)
    is_outdated = reading.scene != part.scene
    place = placement.column, placement.scale
    return PhotoProfile(comparison, raw, *place, sentence, photo, is_outdated)


def _compare(part: PhotoPart, reading: Reading) -> Comparison | None:
    placement, stripes = part.placement, part.compared_stripes
    if stripes is None:
        return None
    first = placement.column + stripes.region.first_column * placement.scale
    swing = stripes.high - stripes.low
    comparison = compare(stripes.flattened, reading.profile, first, placement.scale, swing)
    if not part.is_enhanced:
        return comparison
    return enhance_comparison(comparison, reading.signal, reading.scene.model.enhancement)

"""What is computed from the open photo: lamps, chips, stripes, comparison and placement."""

import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gui.kinds import SnapshotOf
from gui.photo.photo_bench import PhotoBench
from gui.user import PATIENCE_S
from matches import match_with
from PIL import Image
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo import photo_work
from occ_gui.photo.pane import LampSearch
from occ_gui.photo.photo_work import photo_profile
from occ_gui.photo.shown_photo import PartEdits
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.choices import PlacedPhoto, Placement
from occ_gui.values.photo_results import MatchOutcome, PhotoProfile
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError
from occ_model.photo.comparison import compare
from occ_model.photo.reading.load import Photo
from occ_model.results.chip_reading import ChipReading
from occ_model.results.comparison import Comparison
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Stripes

SENTENCE = "No stripes at all."

READING = ChipReading(np.array([1, 0], np.uint8), 9.0, 1.0, 0.0, Region(0, 9, 0, 60))


def stripes_of(photo: Photo) -> Stripes:
    """Return all columns of a photo from the tenth on as stripes."""
    rows, columns = photo.image.shape
    profile = photo.profile[10:]
    low, high = np.full(len(profile), 40.0), np.full(len(profile), 200.0)
    return Stripes(Region(0, rows, 10, columns), profile, low, high, 20.0, 0.1, 0.0)


class Bench(PhotoBench):
    """A photo and its comparison; the test decides when the search for stripes ends."""

    def __init__(self, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
        super().__init__()
        self.searched: list[Photo] = []
        self.go_on = threading.Event()
        self.go_on.set()
        self.stripes: Callable[[Photo], Stripes] = stripes_of
        monkeypatch.setattr(photo_work, "find_stripes", self._find)
        self.updater: Any = photo_work.make_stripe_updater(self.store, self.results_store)
        self._qtbot = qtbot

    def run(self, updater: object) -> None:
        """Run another updater in place of the search for stripes."""
        self.updater.task.stop()
        self.updater = updater

    def _find(self, photo: Photo, region: object = None) -> Stripes:
        assert self.go_on.wait(PATIENCE_S)
        self.searched.append(photo)
        return self.stripes(photo)

    def compare(self, reading: Snapshot, photo: Photo) -> None:
        self.show_reading(reading)
        self.show_photo(photo)
        self.wait()

    def wait(self) -> None:
        self.go_on.set()
        self._qtbot.waitUntil(lambda: self.updater.task.is_idle)

    def move(self, placement: Placement | None) -> None:
        document = self.results_store.results.document
        self.choose(
            placed_photo=None if placement is None else PlacedPhoto(document.source, placement)
        )

    def show_match(self, stripes: Stripes, scene: occ.Scene | None = None) -> None:
        match = match_with(scene=scene or occ.Scene(), stripes=stripes, profile=stripes.profile)
        self.change(outcome=MatchOutcome(None, match, ("switching_frequency", 1e4)))

    def set_enhanced(self, enhanced: bool) -> None:
        self.store.put(replace(self.store.workspace, is_enhanced=enhanced))

    @property
    def last(self) -> PhotoProfile:
        return photo_profile(self.shown)

    @property
    def comparison(self) -> Comparison:
        return self.last.comparison


@pytest.fixture
def bench(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    bench = Bench(qtbot, monkeypatch)
    yield bench
    bench.go_on.set()
    bench.updater.task.stop()


def refuse(_photo: Photo) -> Stripes:
    raise MatchError(SENTENCE)


def test_the_photo_is_drawn_as_it_is_until_its_stripes_are_found(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.show_reading(snapshot_of())
    bench.go_on.clear()
    bench.show_photo(photo)
    assert bench.last.comparison is None
    assert bench.last.sentence == ""
    assert bench.last.raw is photo.profile
    bench.wait()
    assert bench.comparison.correlation != 0.0


def test_the_photo_is_compared_flattened_and_from_its_region_on(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    snapshot = snapshot_of()
    bench.compare(snapshot, photo)
    flattened = stripes_of(photo).flattened
    for placement in (Placement(300.0, 5.0), Placement(200.25, 0.0, 2.5)):
        bench.move(placement)
        first = placement.column + 10 * placement.scale
        expected = compare(flattened, snapshot.frame.profile, first, placement.scale)
        assert bench.comparison.first_column == expected.first_column
        assert bench.comparison.photo.tolist() == expected.photo.tolist()
        assert bench.comparison.rmse == expected.rmse
        assert (bench.last.first_column, bench.last.scale) == (placement.column, placement.scale)


def test_stripes_are_searched_once_for_all_comparisons(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.show_photo(photo)
    for changes in ({}, {"exposure_time": 30e-6}, {"iso": 50.0}):
        snapshot = snapshot_of(**changes)
        bench.show_reading(snapshot)
        bench.wait()
        first = bench.comparison.first_column
        length = len(bench.comparison.simulated)
        levels = snapshot.frame.profile[first : first + length]
        assert bench.comparison.simulated.tolist() == levels.tolist()
    assert bench.searched == [photo]


def test_enhanced_columns_are_compared_after_each_is_enhanced_by_its_own_histogram(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    snapshot = snapshot_of()
    bench.compare(snapshot, photo)
    plain, raw = bench.comparison.photo, photo.profile
    for enhanced in (True, False):
        bench.set_enhanced(enhanced)
        shown, profile = bench.comparison, snapshot.levels(enhanced=enhanced)
        first, length = shown.first_column, len(shown.simulated)
        assert shown.simulated.tolist() == profile[first : first + length].tolist()
        photos = [enhance(one, "equalization") if enhanced else one for one in (plain, raw)]
        assert [shown.photo.tolist(), bench.last.raw.tolist()] == [one.tolist() for one in photos]
        if enhanced:
            correlation = np.corrcoef(shown.photo, shown.simulated)[0, 1]
            assert shown.correlation == pytest.approx(correlation)


def test_without_stripes_or_beside_the_picture_the_photo_is_drawn_with_a_sentence(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.compare(snapshot_of(), photo)
    bench.move(Placement(1e5))
    assert bench.last.comparison is None
    assert bench.last.sentence.endswith(".")
    bench.move(None)
    assert bench.comparison.first_column > 0
    bench.stripes = refuse
    bench.show_photo(replace(photo))
    bench.wait()
    assert bench.last.comparison is None
    assert bench.last.sentence == SENTENCE
    assert bench.last.raw is photo.profile
    bench.show_photo(None)
    assert bench.last is None


def test_a_match_leaves_the_residual_of_a_scene_as_it_was(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    snapshot = snapshot_of()
    bench.compare(snapshot, photo)
    before = bench.comparison.residual.tolist()
    found = stripes_of(photo)
    fitted = replace(found, low=found.low + np.linspace(0.0, 90.0, len(found.low)))
    for scene in (None, snapshot.scene):  # not applied, and applied
        bench.show_match(fitted, scene)
        assert bench.comparison.residual.tolist() == before


def test_a_match_is_not_overtaken_by_the_search_for_stripes(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.stripes = refuse
    bench.show_reading(snapshot_of())
    bench.go_on.clear()
    bench.show_photo(photo)
    bench.show_match(stripes_of(photo))
    bench.wait()
    assert bench.last.sentence == ""
    assert bench.comparison is not None


def test_a_simulation_without_stripes_is_not_compared(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.show_photo(photo)
    bench.wait()
    bench.show_reading(snapshot_of(exposure_time=5.0))  # white from edge to edge
    assert bench.last.comparison is None
    assert bench.last.sentence == "The simulation has no stripes to compare there."
    bench.show_reading(snapshot_of())
    assert bench.comparison is not None
    assert bench.last.sentence == ""


def test_a_photo_lies_at_the_panels_corner_or_where_it_was_put_but_not_where_the_last_one_was(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.show_photo(photo)
    bench.move(Placement(1.0, 2.0, 3.0))
    assert bench.shown.placement == Placement(1.0, 2.0, 3.0)
    bench.show_photo(photo)
    for distance in (1.2, 2.0):
        snapshot = snapshot_of(distance=distance)
        bench.show_reading(snapshot)
        column, row = snapshot.panel_origin
        assert bench.shown.placement == Placement(column, row)
    bench.wait()
    # Once its lamp is found, which begins in its tenth column, that lies on the panel.
    assert bench.shown.placement == Placement(column - 10.0, row)


def test_a_photo_of_the_pictures_very_size_lies_pixel_on_pixel(
    bench: Bench, snapshot_of: SnapshotOf, tmp_path: Path
) -> None:
    snapshot = snapshot_of(columns=300)
    Image.fromarray(snapshot.frame.image).save(tmp_path / "a.png")
    bench.show_reading(snapshot)
    bench.show_photo(occ.load_photo(tmp_path / "a.png", "columns"))
    assert bench.shown.placement == Placement()
    bench.wait()


def chips_shown(bench: Bench) -> list[ChipReading | None]:
    bench.run(photo_work.make_chip_updater(bench.store, bench.results_store))
    chips, shown = (
        bench.results_store.select(lambda results: results.chips),
        list[ChipReading | None](),
    )
    chips.changed.connect(shown.append)
    return shown


def test_chips_are_those_of_the_part_that_is_matched_and_there_may_be_none(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, bench: Bench
) -> None:
    of_part = replace(READING, start=10.0)

    def read(_photo: Photo, region: Region | None) -> ChipReading:
        if region is None:
            raise MatchError("No chips can be read.")
        return of_part

    monkeypatch.setattr(occ, "read_chips", read)
    shown = chips_shown(bench)
    bench.show_photo(photo)
    bench.wait()
    assert shown == []
    PartEdits(bench.store, bench.results_store).draw(Region(0, 9, 10, 60))
    bench.wait()
    assert shown == [of_part]


def test_lamps_are_found_when_asked_for_and_come_back_with_what_was_set(
    photo: Photo, monkeypatch: pytest.MonkeyPatch, bench: Bench
) -> None:
    """As happens at the end of a lesson; a new request searches again."""
    searched: list[Photo] = []

    def find(shown: Photo, _report: object) -> tuple[Lamp, ...]:
        searched.append(shown)
        return (Lamp(Region(0, 9, 0, 20), np.array([[0, 9, 0, 20]]), 200.0, modulated=False),)

    monkeypatch.setattr(occ, "find_lamps", find)
    search = LampSearch(bench.photos, bench.results_store)
    bench.run(search)
    bench.show_photo(photo)
    assert searched == []
    search.find()
    assert bench.shown.search == ((), True, "")
    bench.wait()
    users = bench.store.workspace
    (lamp,) = bench.shown.lamps
    assert bench.shown.search == ((lamp,), False, "")
    bench.show_photo(replace(photo))
    assert bench.shown.lamps == ()
    bench.store.put(users)
    assert bench.shown.lamps == (lamp,)
    assert searched == [photo]
    search.find()
    bench.show_photo(replace(photo))
    bench.store.put(users)
    assert bench.shown.search == ((), False, ""), "the search has ended with its photo"

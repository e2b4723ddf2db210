"""Photo and simulation are compared whenever either changes, and the photo lies where it fits."""

import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo import comparison_controller as comparison_room
from occ_gui.photo.comparison_controller import ComparisonController
from occ_gui.picture.placement import Placement, PlacementStore
from occ_gui.shell.photo_profile import PhotoProfile
from occ_gui.simulation.snapshot import Snapshot
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError
from occ_model.photo.comparison import compare
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.match import Comparison, Match, Stripes

Grey = NDArray[np.uint8]
SnapshotOf = Callable[..., Snapshot]
PATIENCE_S = 10.0

SENTENCE = "No stripes at all."


def stripes_of(photo: Photo) -> Stripes:
    """Take all columns of a photo from the tenth on for stripes."""
    rows, columns = photo.image.shape
    profile = photo.profile[10:]
    low, high = np.full(len(profile), 40.0), np.full(len(profile), 200.0)
    return Stripes(Region(0, rows, 10, columns), profile, low, high, 20.0, 0.1, 0.0)


class Bench:
    """A controller on a mock pane, and a hand on the search for stripes."""

    def __init__(self, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
        self.shown: list[PhotoProfile | None] = []
        self.searched: list[Photo] = []
        self.go_on = threading.Event()
        self.go_on.set()
        self.stripes: Callable[[Photo], Stripes] = stripes_of
        monkeypatch.setattr(comparison_room, "find_stripes", self._find)
        self.placements = PlacementStore()
        self.controller = ComparisonController(self.placements, self)
        self._qtbot = qtbot

    def _find(self, photo: Photo, region: object = None) -> Stripes:
        assert self.go_on.wait(PATIENCE_S)
        self.searched.append(photo)
        return self.stripes(photo)

    def show_photo_profile(self, profile: PhotoProfile | None) -> None:
        self.shown.append(profile)

    def residual(self) -> None:
        self.go_on.set()
        self._qtbot.waitUntil(lambda: self.controller.runner.is_idle)

    @property
    def last(self) -> PhotoProfile:
        assert self.shown[-1] is not None
        return self.shown[-1]

    @property
    def comparison(self) -> Comparison:
        assert self.last.comparison is not None
        return self.last.comparison


@pytest.fixture
def bench(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    bench = Bench(qtbot, monkeypatch)
    yield bench
    bench.go_on.set()
    bench.controller.stop()


def refuse(_photo: Photo) -> Stripes:
    raise MatchError(SENTENCE)


def test_without_a_photo_nothing_is_compared(bench: Bench, snapshot_of: SnapshotOf) -> None:
    bench.controller.show_reading(snapshot_of())
    assert bench.shown == [None]


def test_the_photo_is_drawn_as_it_is_until_its_stripes_are_found(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_reading(snapshot_of())
    bench.go_on.clear()
    bench.controller.show_photo(photo)
    assert bench.last.comparison is None
    assert bench.last.sentence == ""
    assert bench.last.raw is photo.profile
    bench.residual()
    assert bench.comparison.correlation != 0.0


def test_the_photo_is_compared_flattened_and_from_its_region_on(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    snapshot = snapshot_of()
    bench.controller.show_reading(snapshot)
    bench.controller.show_photo(photo)
    bench.residual()
    flattened = stripes_of(photo).flattened
    for placement in (Placement(300.0, 5.0), Placement(200.25, 0.0, 2.5)):
        bench.placements.move(placement)
        first = placement.column + 10 * placement.scale
        expected = compare(flattened, snapshot.frame.profile, first, placement.scale)
        assert bench.comparison.first_column == expected.first_column
        assert bench.comparison.photo.tolist() == expected.photo.tolist()
        assert bench.comparison.rmse == expected.rmse
        assert (bench.last.first_column, bench.last.scale) == (placement.column, placement.scale)


def test_stripes_are_searched_once_for_all_comparisons(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_photo(photo)
    for changes in ({}, {"exposure_time": 30e-6}, {"iso": 50.0}):
        snapshot = snapshot_of(**changes)
        bench.controller.show_reading(snapshot)
        bench.residual()
        first = bench.comparison.first_column
        length = len(bench.comparison.simulated)
        levels = snapshot.frame.profile[first : first + length]
        assert bench.comparison.simulated.tolist() == levels.tolist()
    assert bench.searched == [photo]


def test_where_enhanced_columns_are_looked_at_they_are_compared(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    snapshot = snapshot_of()
    bench.controller.show_photo(photo)
    bench.controller.show_reading(snapshot)
    bench.residual()
    for enhanced, profile in ((True, snapshot.frame.signal), (False, snapshot.frame.profile)):
        bench.controller.set_enhanced(enhanced)
        first = bench.comparison.first_column
        length = len(bench.comparison.simulated)
        assert bench.comparison.simulated.tolist() == profile[first : first + length].tolist()


def test_an_enhanced_photo_is_so_by_its_own_histogram(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_photo(photo)
    bench.controller.show_reading(snapshot_of())
    bench.residual()
    before = bench.comparison
    bench.controller.set_enhanced(True)
    after = bench.comparison
    assert after.photo.tolist() == enhance(before.photo, "equalization").tolist()
    assert after.correlation == pytest.approx(np.corrcoef(after.photo, after.simulated)[0, 1])
    assert bench.last.raw.tolist() == enhance(photo.profile, "equalization").tolist()
    exported = bench.controller.comparison()
    assert exported is not None
    assert exported.photo.tolist() == after.photo.tolist()
    bench.controller.set_enhanced(False)
    assert bench.comparison.photo.tolist() == before.photo.tolist()


def test_without_stripes_the_photo_is_drawn_with_a_sentence(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.stripes = refuse
    bench.controller.show_reading(snapshot_of())
    bench.controller.show_photo(photo)
    bench.residual()
    assert bench.last.comparison is None
    assert bench.last.sentence == SENTENCE
    assert bench.last.raw is photo.profile


def test_a_photo_moved_beside_the_picture_gives_a_sentence(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_reading(snapshot_of())
    bench.controller.show_photo(photo)
    bench.residual()
    bench.placements.move(Placement(1e5))
    assert bench.last.comparison is None
    assert bench.last.sentence.endswith(".")
    bench.placements.reset()
    assert bench.comparison.first_column > 0


def test_the_stripes_of_a_photo_that_is_gone_are_forgotten(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_reading(snapshot_of())
    bench.go_on.clear()
    bench.controller.show_photo(photo)
    bench.controller.show_photo(None)
    bench.residual()
    assert bench.shown[-1] is None


def test_a_matchs_own_levels_take_the_place_of_those_found(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_reading(snapshot_of())
    bench.controller.show_photo(photo)
    bench.residual()
    before = bench.comparison.correlation
    found = stripes_of(photo)
    fitted = replace(found, low=found.low + np.linspace(0.0, 90.0, len(found.low)))
    bench.controller.show_match(match_with(photo, fitted))
    assert bench.comparison.correlation != before


def test_a_match_is_not_overtaken_by_the_search_for_stripes(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.stripes = refuse
    bench.controller.show_reading(snapshot_of())
    bench.go_on.clear()
    bench.controller.show_photo(photo)
    bench.controller.show_match(match_with(photo, stripes_of(photo)))
    bench.residual()
    assert bench.last.sentence == ""
    assert bench.comparison is not None


def test_a_simulation_without_stripes_is_not_compared(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_photo(photo)
    bench.residual()
    bench.controller.show_reading(snapshot_of(exposure_time=5.0))  # white from rim to rim
    assert bench.last.comparison is None
    assert bench.last.sentence == "The simulation has no stripes there to compare."
    bench.controller.show_reading(snapshot_of())
    assert bench.comparison is not None
    assert bench.last.sentence == ""


def match_with(photo: Photo, stripes: Stripes) -> Match:
    return Match(
        scene=occ.Scene(), stripes=stripes, readout_time=8e-6, switching_frequency=1e4,
        exposure_time=68e-6, start_time=0.0, gamma=2.22, uncertainties={}, pattern="10",
        pattern_was_read=False, profile=stripes.profile, correlation=1.0,
    )  # fmt: skip


def test_a_photo_lies_at_the_panels_corner(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    bench.controller.show_photo(photo)
    for distance in (1.2, 2.0):
        snapshot = snapshot_of(distance=distance)
        bench.controller.show_reading(snapshot)
        assert bench.placements.placement == Placement(*snapshot.panel_origin)


def test_a_photo_of_the_pictures_very_size_lies_pixel_on_pixel(
    bench: Bench, snapshot_of: SnapshotOf, tmp_path: Path
) -> None:
    snapshot = snapshot_of(columns=300)
    Image.fromarray(snapshot.frame.image).save(tmp_path / "a.png")
    bench.controller.show_reading(snapshot)
    bench.controller.show_photo(occ.load_photo(tmp_path / "a.png", "columns"))
    assert bench.placements.placement == Placement()
    bench.residual()


def test_another_photo_does_not_lie_where_the_last_one_was_put(
    bench: Bench, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    snapshot = snapshot_of()
    bench.controller.show_reading(snapshot)
    bench.controller.show_photo(photo)
    bench.placements.move(Placement(1.0, 2.0, 3.0))
    bench.controller.show_photo(photo)
    assert bench.placements.placement == Placement(*snapshot.panel_origin)
    bench.residual()

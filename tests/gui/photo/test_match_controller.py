"""A match: requested with the user's choices, cancelled, applied as one step, saved as a preset."""

import threading
from collections.abc import Iterator
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any

import pytest
from gui.photo.photo_bench import PhotoBench
from gui.user import PATIENCE_S
from matches import match_with
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo.match_controller import MatchController
from occ_gui.photo.shown_photo import PartEdits
from occ_gui.values.choices import LoadOptions, MatchChoice
from occ_gui.values.photo_results import ListedRows
from occ_model.errors import MatchError
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.match import Match
from occ_model.results.photo_table import PhotoRow
from occ_model.scene.presets import USER_FOLDER, preset_named, user_presets
from occ_model.scene.scene import Scene

DAY = date(2026, 1, 31)


class Bench(PhotoBench):
    """A controller with a photo, and a model that returns a given match."""

    def __init__(self, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, scene: Scene) -> None:
        super().__init__(scene)
        self.events: list[object] = []
        self.failures: list[str] = []
        self.asked: list[dict[str, Any]] = []
        self.begun, self.go_on = threading.Event(), threading.Event()
        self.go_on.set()
        self.refusal: tuple[str, ...] = ()
        monkeypatch.setattr(occ, "match_photo", self._match)
        self.controller = MatchController(self.scenes, self.photos, self.results_store)
        self.parts = PartEdits(self.store, self.results_store)
        self._was_running = False
        self.controller.task.reported.connect(self.events.append)
        self.results_store.changed.connect(self._note)
        self.controller.failed.connect(self.failures.append)
        self._qtbot = qtbot

    def _note(self) -> None:
        """Record when a match begins and ends."""
        was_running, self._was_running = self._was_running, self.shown.is_matching
        if was_running != self._was_running:
            self.events.append("ended" if was_running else "begun")

    def _match(self, photo: Photo, scene: Scene, *, progress: Any, **asked: Any) -> Match:
        self.asked.append({"photo": photo, "scene": scene, **asked})
        self.begun.set()
        assert self.go_on.wait(PATIENCE_S)
        progress(0.5)
        if self.refusal:
            raise MatchError(*self.refusal)
        found = scene.replace(readout_time=9e-6)
        return match_with(
            scene=found, readout_time=9e-6, pattern_was_read=False,
            switching_frequency=found.transmitter.switching_frequency,
            uncertainties={"readout_time": 2e-9, "exposure_time": 3e-7},
        )  # fmt: skip

    def start(self, **choice: Any) -> None:
        self.controller.start(MatchChoice(**choice))
        self._qtbot.waitUntil(lambda: self.controller.task.is_idle)

    @property
    def validity(self) -> str:
        """Why the match is not the present one."""
        why, is_usable = self.shown.validity
        assert is_usable or why
        return why


@pytest.fixture
def bench(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, small_scene: Scene, photo: Photo
) -> Iterator[Bench]:
    bench = Bench(qtbot, monkeypatch, small_scene)
    bench.show_photo(photo)
    yield bench
    bench.go_on.set()
    bench.controller.task.stop()


def test_a_match_of_what_was_chosen_is_announced_from_its_start_to_its_result(
    bench: Bench, photo: Photo, small_scene: Scene
) -> None:
    bench.start(sent="read", estimate="switching_frequency", fit_gamma=True)
    assert bench.events == ["begun", 0.0, 0.5, "ended"]
    assert bench.controller.match is not None
    assert bench.failures == []
    assert bench.asked == [{
        "photo": photo, "scene": small_scene, "estimate": "switching_frequency", "sent": "read",
        "fit_gamma": True, "region": None,
    }]  # fmt: skip


def test_a_lamp_of_any_duty_is_asked_for(bench: Bench, small_scene: Scene) -> None:
    bench.start(sent="lamp", lamp_frequency=1234.5)
    (asked,) = bench.asked
    # As the shell's --led-frequency asks for it: a lamp dimmed by its pulses' width blinks, too.
    assert asked["sent"] == "auto"
    assert asked["scene"] == small_scene.replace(light="lamp", lamp_frequency=1234.5, duty=0.5)


def test_an_impossible_lamp_is_refused_with_a_sentence(bench: Bench) -> None:
    bench.start(sent="lamp", lamp_frequency=1e12)
    (sentence,) = bench.failures
    assert sentence.startswith("Lamp frequency is ")
    assert bench.asked == []
    bench.events.clear()
    bench.show_photo(None)
    bench.start()
    assert (bench.events, bench.asked) == ([], [])


def test_a_refusal_gives_each_reason_and_the_last_match_stays(bench: Bench) -> None:
    bench.start()
    found = bench.controller.match
    bench.refusal = ("No scene explains these stripes.", "They do not repeat.")
    bench.start()
    assert bench.failures == ["No scene explains these stripes."]
    assert bench.shown.refusal == bench.refusal
    assert bench.controller.match is found
    assert "refused" in bench.validity
    bench.parts.draw(PARTS[0])
    assert bench.shown.refusal == (), "it is of the part that was matched"
    bench.parts.match_whole()
    bench.refusal = ()
    bench.start()
    assert bench.validity == ""
    assert bench.shown.refusal == ()


PARTS = (Region(0, 5, 0, 20), Region(0, 5, 20, 40))


def test_a_match_of_another_region_is_marked_as_such(bench: Bench) -> None:
    bench.parts.draw(PARTS[0])
    bench.start()
    assert bench.asked[-1]["region"] == PARTS[0]
    assert bench.validity == ""
    bench.parts.draw(PARTS[1])
    assert "another part" in bench.validity
    before = bench.scenes.scene
    bench.controller.apply()
    assert bench.scenes.scene == before
    assert "another part" in bench.failures[-1]
    bench.parts.match_whole()
    assert "another part" in bench.validity
    bench.parts.draw(replace(PARTS[0]))
    assert bench.validity == ""


def test_a_match_is_marked_while_another_photo_is_read(bench: Bench) -> None:
    bench.start()
    shown = bench.choice
    bench.choose(path=Path("other.png"))
    assert "is being loaded" in bench.validity
    bench.store.put(replace(bench.store.workspace, photo=shown))  # it could not be read
    assert bench.validity == ""


def test_a_cancelled_match_has_no_result_and_the_last_one_stays(bench: Bench, qtbot: QtBot) -> None:
    bench.start()
    found = bench.controller.match
    bench.begun.clear()
    bench.go_on.clear()
    bench.controller.start(MatchChoice())
    assert bench.begun.wait(PATIENCE_S)
    bench.controller.cancel()
    bench.go_on.set()
    qtbot.wait(20)
    assert bench.events.count("ended") == 2
    assert bench.controller.match is found
    assert bench.controller.task.is_idle
    bench.controller.cancel()
    assert bench.events.count("ended") == 2
    assert len(bench.asked) == 2


def test_another_photo_ends_the_match_and_forgets_what_was_found(
    bench: Bench, photo: Photo, small_scene: Scene
) -> None:
    bench.start()
    bench.go_on.clear()
    bench.controller.start(MatchChoice())
    bench.show_photo(replace(photo))
    assert bench.events[-1] == "ended"
    bench.go_on.set()
    bench.controller.apply()
    assert bench.controller.match is None
    assert bench.scenes.scene == small_scene


def test_a_match_comes_back_with_its_photo_and_stays_where_another_is_cancelled(
    bench: Bench, photo: Photo
) -> None:
    """As happens at the end of a lesson."""
    bench.start()
    users, found = bench.store.workspace, bench.shown.outcome
    bench.show_photo(replace(photo))
    assert bench.controller.match is None
    bench.start()
    bench.store.put(users)
    assert bench.shown.outcome == found
    bench.go_on.clear()
    bench.controller.start(MatchChoice())
    bench.controller.cancel()
    bench.go_on.set()
    assert bench.shown.outcome == found


def test_a_photo_of_the_table_has_its_rows_match_until_it_is_matched_by_itself(
    bench: Bench, photo: Photo
) -> None:
    row = PhotoRow(photo.path, "sure", "", match_with())

    def show_listed(options: LoadOptions) -> None:
        given, settings = ("switching_frequency", 1e4), MatchSettings(bench.scenes.scene)
        listed = ListedRows((photo.path,), {0: row}, options, given, settings)
        bench.results_store.put(replace(bench.results_store.results, listed=listed))

    show_listed(LoadOptions("lines"))
    assert bench.controller.match is None, "read in another way it is not what the table matched"
    show_listed(LoadOptions())
    assert bench.controller.match is row.match
    assert bench.shown.outcome.is_listed
    bench.controller.apply()
    assert row.match is not None
    assert bench.scenes.scene == row.match.scene
    bench.refusal = ("No.",)
    bench.start()
    assert (bench.controller.match, bench.shown.refusal) == (row.match, ("No.",))
    bench.refusal = ()
    bench.start()
    assert bench.controller.match is not row.match
    bench.show_photo(replace(photo, path=Path("other.png")))
    assert bench.controller.match is None


def test_applying_puts_what_was_found_into_the_scene_as_one_step(
    bench: Bench, small_scene: Scene
) -> None:
    bench.start(sent="lamp")
    assert bench.scenes.scene == small_scene
    bench.controller.apply()
    assert bench.scenes.scene == bench.controller.match.scene
    assert bench.scenes.undo_stack.count() == 1
    assert "stripes.png" in bench.scenes.undo_stack.undoText()
    bench.scenes.undo_stack.undo()
    assert bench.scenes.scene == small_scene


def test_recorded_camera_settings_are_applied_in_one_step_or_refused_with_a_sentence(
    bench: Bench, photo: Photo, small_scene: Scene
) -> None:
    bench.controller.apply_camera_settings()
    assert bench.scenes.scene == small_scene, "there are none"
    bench.show_photo(replace(photo, exposure_time=1e-3, iso=800.0))
    bench.controller.apply_camera_settings()
    assert bench.scenes.scene == small_scene.replace(exposure_time=1e-3, iso=800.0)
    assert bench.scenes.undo_stack.count() == 1
    assert "stripes.png" in bench.scenes.undo_stack.undoText()
    bench.show_photo(replace(photo, iso=1e12, exposure_time=1e-3))
    bench.controller.apply_camera_settings()
    (sentence,) = bench.failures
    assert sentence.startswith("iso is ")
    assert bench.scenes.undo_stack.count() == 1


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(USER_FOLDER, str(tmp_path / "own"))
    return tmp_path / "own"


def test_a_saved_match_records_values_photo_date_uncertainty_and_the_inputs_it_was_made_with(
    bench: Bench, own: Path
) -> None:
    bench.start(sent="lamp", lamp_frequency=1000.0)
    bench.choose(certain={"lamp_frequency": 1000.0})
    assert bench.controller.save("my phone", "Measured from stripes.png", DAY)
    assert (own / "my phone.toml").is_file()
    preset = preset_named("my phone")
    assert preset.scene == bench.controller.match.scene
    source = preset.sources["readout_time"]
    for part in ("±2.0 ns", "photo stripes.png", "2026-01-31", "lamp frequency being 1 kHz"):
        assert part in source
    assert "±300 ns" in preset.sources["exposure_time"]
    assert "pattern" not in preset.sources
    bench.choose(certain={})
    bench.start(estimate="readout_time")
    bench.refusal = ("No.",)
    bench.start(estimate="switching_frequency")
    bench.controller.save("mine", "", DAY)
    source = preset_named("mine").sources["readout_time"]
    assert "switching frequency assumed to be 10 kHz" in source
    bench.choose(certain={"switching_frequency": 10e3})
    bench.controller.save("sure", "", DAY)
    assert "switching frequency being 10 kHz" in preset_named("sure").sources["readout_time"]


def test_an_invalid_name_is_refused_with_a_sentence(bench: Bench, own: Path) -> None:
    assert not bench.controller.save("mine", "", DAY)
    assert not own.exists(), "there is no match"
    bench.start()
    for name in ("phone-136us", "a/b"):
        assert not bench.controller.save(name, "", DAY)
        assert repr(name) in bench.failures[-1]
    assert user_presets() == ()

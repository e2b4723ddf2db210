"""Results before the exact picture: a reading of the profile, and a draft."""

import math
from dataclasses import astuple
from threading import Event
from typing import Any

import numpy as np
import pytest
from gui.kinds import collect
from gui.simulation.conftest import SimulationBench
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.simulation import controller, jobs
from occ_gui.simulation.snapshot import Picture
from occ_gui.values.simulated import LEAST_DRAFT_STEP, SimulationRequest
from occ_model.effects import plan
from occ_model.effects.effect import PaperView
from occ_model.effects.plan import plan_of
from occ_model.results.frame import Plan
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation import render
from occ_model.simulation.render import render_with

SETTINGS = SimulationSettings()


def is_draft(picture: Picture) -> bool:
    return picture.frame.rows_step > 1


def test_a_scene_is_read_before_its_picture_is_there(
    bench: SimulationBench, release: Event, qtbot: QtBot
) -> None:
    bench.store.change(iso=200.0)
    reader = bench.views[1]
    qtbot.waitUntil(lambda: reader.readings[-1].scene == bench.store.scene)
    early = reader.readings[-1]
    assert (early.source, len(bench.scenes)) == ("profile", 1)
    release.set()
    bench.wait_until_idle()
    assert reader.readings[-1] is bench.views[0].snapshots[-1]
    assert reader.readings[-1].source == "picture"
    assert [result.code for result in early.results.values()] == [
        result.code for result in reader.readings[-1].results.values()
    ]


def test_no_reading_is_replaced_by_one_of_an_earlier_scene(
    bench: SimulationBench, release: Event, qtbot: QtBot
) -> None:
    reader = bench.views[0]
    before = len(reader.readings)
    bench.store.change(iso=150.0)
    bench.store.change(iso=200.0)
    qtbot.waitUntil(lambda: reader.readings[-1].scene.camera.iso == 150.0)
    release.set()
    bench.wait_until_idle()
    assert [scene.camera.iso for scene in bench.scenes[1:]] == [150.0, 200.0]
    of_pictures = [reading for reading in reader.readings[before:] if reading.source == "picture"]
    assert [reading.scene.camera.iso for reading in of_pictures] == [200.0]
    assert reader.readings[-1] is of_pictures[-1]


@pytest.fixture
def pictures(bench: SimulationBench, monkeypatch: pytest.MonkeyPatch) -> list[Picture]:
    """Draft pictures of any size, and record all that are delivered."""
    monkeypatch.setattr(jobs, "SMALL_PICTURE", 0)
    return collect(bench.controller.picture_ready)


def test_a_draft_of_the_scene_comes_before_its_exact_picture(
    bench: SimulationBench, pictures: list[Picture]
) -> None:
    bench.change(iso=200.0)
    draft, exact = pictures
    assert (is_draft(draft), is_draft(exact)) == (True, False)
    assert draft.frame.scene == exact.frame.scene == bench.store.scene
    assert draft.frame.plan == exact.frame.plan
    assert bench.views[0].snapshots[-1].frame is exact.frame


def test_exact_rows_of_a_small_panel_come_before_the_others(
    bench: SimulationBench, pictures: list[Picture]
) -> None:
    bench.store.change(rows=1000, distance=6.0)
    bench.wait_until_idle()
    draft, panel, exact = (picture.frame for picture in pictures)
    assert draft.rows_step > panel.rows_step == exact.rows_step == 1
    assert len(panel.rows) < len(exact.rows) == 1000
    np.testing.assert_array_equal(panel.camera_image, exact.camera_image[panel.rows])


@pytest.mark.parametrize("jpeg", [0, 80])
def test_the_effects_of_a_scene_are_chosen_once_for_draft_and_picture(
    bench: SimulationBench, pictures: list[Picture], monkeypatch: pytest.MonkeyPatch, jpeg: int
) -> None:
    bench.settings.set_tolerance(0.0)  # no effect is left out that a signal may need
    bench.wait_until_idle()
    pictures.clear()
    observables: list[str] = []

    def note(view: PaperView, settings: SimulationSettings) -> Plan:
        observables.append(settings.observable)
        return plan_of(view, settings)

    for module in (render, plan):
        monkeypatch.setattr(module, "plan_of", note)
    bench.change(iso=200.0, jpeg_quality=jpeg)
    assert [is_draft(picture) for picture in pictures] == [True, False]
    # An early reading without pixels simulates all effects of the scene, without a plan.
    assert observables == ["image"]


@pytest.mark.parametrize("jpeg", [0, 80])
def test_a_draft_and_the_verdict_on_it_are_painted_at_once(
    bench: SimulationBench, pictures: list[Picture], jpeg: int
) -> None:
    """Qt paints when no other event waits, which an event of low priority imitates."""

    class PaintRecorder(QObject):
        def __init__(self) -> None:
            super().__init__()
            self.scenes: list[tuple[Scene, Scene]] = []

        def event(self, event: QEvent) -> bool:
            if event.type() == QEvent.Type.User:
                of_reading = bench.views[1].readings[-1].scene
                self.scenes.append((pictures[-1].frame.scene, of_reading))
            return super().event(event)

    recorder = PaintRecorder()
    bench.controller.picture_ready.connect(
        lambda _: QApplication.postEvent(
            recorder, QEvent(QEvent.Type.User), Qt.EventPriority.LowEventPriority.value
        )
    )
    for iso in (110.0, 120.0, 130.0):
        bench.change(iso=iso, jpeg_quality=jpeg)
    assert len(recorder.scenes) >= 3
    assert all(of_picture == of_reading for of_picture, of_reading in recorder.scenes)


def test_drafts_have_the_rows_that_the_screen_shows(
    bench: SimulationBench, pictures: list[Picture]
) -> None:
    bench.controller.set_draft_resolution(lambda: 7.9)
    bench.store.change(iso=200.0)
    # A step of less than four rows saves no time.
    bench.controller.set_draft_resolution(lambda: 0.5)
    bench.wait_until_idle()
    bench.change(iso=300.0)
    steps = [picture.frame.rows_step for picture in pictures if is_draft(picture)]
    assert steps == [7, LEAST_DRAFT_STEP]


def test_a_picture_without_pixels_that_differ_needs_no_draft(
    bench: SimulationBench, pictures: list[Picture]
) -> None:
    bench.settings.set_tolerance(math.inf)
    bench.wait_until_idle()
    assert [is_draft(picture) for picture in pictures] == [False]


def test_a_scene_that_is_read_from_pixels_is_read_from_its_draft_first(
    bench: SimulationBench, pictures: list[Picture]
) -> None:
    bench.change(jpeg_quality=80)
    early, exact = bench.views[1].readings[-2:]
    assert (early.source, exact.source) == ("draft", "picture")
    assert early.scene == exact.scene == bench.store.scene
    for of_draft, of_picture in zip(early.results.values(), exact.results.values(), strict=True):
        assert of_draft.code == of_picture.code
        assert of_draft.region is not None
        assert of_picture.region is not None
        ends = np.subtract(astuple(of_draft.region), astuple(of_picture.region))
        assert np.abs(ends).max() <= 2 * LEAST_DRAFT_STEP


def test_while_the_scene_changes_only_drafts_are_made(
    bench: SimulationBench, pictures: list[Picture]
) -> None:
    """Each draft causes the next change; the second change is replaced by the third."""
    isos = iter([110.0, 120.0, 130.0])

    def change_again(_picture: Picture) -> None:
        iso = next(isos, None)
        if iso is not None:
            bench.store.change(iso=iso)

    bench.controller.picture_ready.connect(change_again)  # the work waits for its paint
    bench.store.change(iso=90.0)
    bench.change(iso=100.0)
    # The second change had no draft.
    assert [is_draft(picture) for picture in pictures] == [*4 * [True], False]
    assert pictures[-1].frame.scene == bench.store.scene
    assert bench.scenes[1:] == [bench.store.scene]


def test_a_picture_under_way_gives_way_to_a_newer_scene(
    bench: SimulationBench, pictures: list[Picture], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The scene changes when its exact picture has been begun."""
    scenes: list[Scene] = []

    def record_and_change(scene: Scene, *arguments: Any, **options: Any) -> Any:
        scenes.append(scene)
        if len(scenes) == 1:
            bench.controller.task.ask(SimulationRequest(scene.replace(iso=300.0), SETTINGS))
        return render_with(scene, *arguments, **options)

    monkeypatch.setattr(controller, "render_with", record_and_change)
    bench.change(iso=200.0)
    assert [scene.camera.iso for scene in scenes] == [200.0, 300.0]
    results = [(picture.frame.scene.camera.iso, is_draft(picture)) for picture in pictures]
    assert results == [(200.0, True), (300.0, True), (300.0, False)]


def test_an_exact_picture_begins_after_more_urgent_work(
    bench: SimulationBench, pictures: list[Picture], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(controller, "CHECK_SECONDS", 0.001)
    counts: list[int] = []

    def must_wait() -> bool:
        counts.append(len(pictures))
        return len(counts) < 4

    bench.controller.defer_while(must_wait)
    bench.change(iso=200.0)
    assert counts == [1] * 4  # after the draft, before the exact picture
    bench.controller.defer_while(lambda: True)  # for ever, longer than the picture waits
    bench.change(iso=210.0)
    assert [is_draft(picture) for picture in pictures] == [True, False] * 2

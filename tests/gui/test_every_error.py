"""Each exception of the model becomes a sentence in the window, and the last good picture stays."""

from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Future
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from every_error import (
    NOT_IN_THE_WINDOW,
    WRONG,
    ErrorClass,
    check_sentence,
    check_that_all_have_a_case,
)
from gui.conftest import LazyWorkers
from gui.soak_actions import FileDialogs
from gui.user import User
from model.plugins.installed_package import importable
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextDocumentFragment
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.detection_map import wiring
from occ_gui.scene.parameter_rows import ChoiceRow, CountRow, ParameterRow, PatternRow, QuantityRow
from occ_gui.simulation.snapshot import Snapshot
from occ_model import plugins
from occ_model.errors import OccError, PluginError
from occ_model.parallel.job import Job, JobResult, WorkersLostError
from occ_model.scene.canonical_text import CanonicalText
from occ_model.scene.parameter_kinds import ChipPattern, Choice, Count, Payload
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.presets import USER_FOLDER, save_preset
from occ_model.scene.refusal import refusal_of, sentence_with_label
from occ_model.scene.scene import Scene


@dataclass
class Stage:
    """A window, its user, and the files and dialogs that the cases need."""

    application: Application
    user: User
    qtbot: QtBot
    dialogs: FileDialogs
    folder: Path

    def choose_in(self, box: QComboBox, place: int) -> None:
        box.setCurrentIndex(place)
        box.activated.emit(place)
        box.textActivated.emit(box.currentText())
        self.user.wait_until_idle()

    def drop(self, name: str, content: str | np.ndarray) -> None:
        path = self.folder / name
        if isinstance(content, str):
            path.write_text(content, encoding="utf-8")
        else:
            Image.fromarray(content).save(path)
        self.application.window.dropped.emit([path])
        self.user.wait_until_idle()

    def choose_file(self, entry: str, path: Path) -> None:
        self.dialogs.answer_with(path)
        self.application.window.actions_by_name[entry].trigger()
        self.user.wait_until_idle()

    def row(self, name: str) -> ParameterRow:
        panels = self.application.controls.panels.values()
        (found,) = [panel.rows[name] for panel in panels if name in panel.rows]
        return found


CASES: dict[ErrorClass, Callable[[Stage], str]] = {}
"""For each class, what a user does to cause it; returns the sentence that the window then shows."""


def causes(error: ErrorClass) -> Callable[[Callable[[Stage], str]], Callable[[Stage], str]]:
    def note(case: Callable[[Stage], str]) -> Callable[[Stage], str]:
        CASES[error] = case
        return case

    return note


@causes(occ.ParameterError)
def _a_value_out_of_range(stage: Stage) -> str:
    stage.user.enter("distance", "-3 m")
    assert stage.row("distance").notice.text() == stage.user.message
    return stage.user.message


@causes(occ.SceneFileError)
def _a_scene_that_is_no_toml(stage: Stage) -> str:
    stage.drop("scene.toml", "format = ")
    return stage.user.message


@causes(occ.PresetError)
def _a_preset_whose_file_is_gone(stage: Stage) -> str:
    (stage.folder / "presets" / "mine.toml").unlink()
    box = stage.application.controls.preset
    stage.choose_in(box, box.findData("mine"))
    return stage.user.message


@causes(occ.ProjectionError)
def _a_panel_behind_the_camera(stage: Stage) -> str:
    stage.user.enter("distance", "0.1 m")
    stage.user.enter("yaw", "70")
    assert stage.row("yaw").notice.text() == stage.user.message
    return stage.user.message


@causes(occ.BandModelUndefined)
def _an_exposure_longer_than_the_period(stage: Stage) -> str:
    stage.user.enter("exposure_time", "1 ms")
    return stage.application.view("profile").reason.text()


@causes(occ.PhotoError)
def _a_photo_that_is_a_text(stage: Stage) -> str:
    stage.drop("photo.png", "no photo")
    return stage.user.message


@causes(occ.VideoError)
def _a_film_that_is_a_text(stage: Stage) -> str:
    (stage.folder / "film.mp4").write_text("no film", encoding="utf-8")
    stage.choose_file("open_film", stage.folder / "film.mp4")
    return stage.user.message


@causes(occ.MatchError)
def _a_photo_without_stripes(stage: Stage) -> str:
    stage.drop("grey.png", np.full((60, 90), 128, np.uint8))
    stage.application.window.actions_by_name["match"].trigger()
    stage.user.wait_until_idle()
    return stage.user.message


@causes(PluginError)
def _a_line_code_that_cannot_be_imported(stage: Stage) -> str:
    row = stage.row("line_code")
    assert isinstance(row, ChoiceRow)
    box = row.field
    box.addItem("mine")  # as its list does when it opens
    stage.choose_in(box, box.count() - 1)
    return stage.user.message


@causes(occ.OutputError)
def _a_folder_to_write_to(stage: Stage) -> str:
    (stage.folder / "folder.toml").mkdir()
    stage.choose_file("save_scene", stage.folder / "folder.toml")
    return stage.user.message


@causes(WorkersLostError)
def _processes_that_end_each_time(stage: Stage) -> str:
    DyingWorkers.is_well = False
    stage.application.window.bring_to_front("map")
    status = stage.application.shell.pane("map").view.status
    stage.qtbot.waitUntil(lambda: "background" in status.toolTip())
    stage.user.wait_until_idle()
    DyingWorkers.is_well = True
    # The line itself is cut where the pane is narrow.
    return QTextDocumentFragment.fromHtml(status.toolTip()).toPlainText()


class DyingWorkers(LazyWorkers):
    """Workers that do nothing while they are well, and end at each job while they are not."""

    is_well = True

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        if not self.is_well:
            raise BrokenExecutor("killed")
        return super().submit(job, channel, run)


@pytest.fixture(autouse=True)
def lazy_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Use workers that end when a case needs it."""
    monkeypatch.setattr(wiring, "new_workers", DyingWorkers)


@pytest.fixture(autouse=True)
def own_preset(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, small_scene: Scene) -> None:
    """Save a preset of the user before the window opens."""
    monkeypatch.setenv(USER_FOLDER, str(tmp_path / "presets"))
    save_preset("mine", small_scene.replace(iso=321.0))


@pytest.fixture(autouse=True)
def broken_plugin(tmp_path: Path) -> Iterator[None]:
    """Install a line code that cannot be imported."""
    with importable(tmp_path, "broken", {plugins.LINE_CODES: {"mine": "broken:code"}}, "1 / 0\n"):
        yield


@pytest.fixture
def raised(monkeypatch: pytest.MonkeyPatch) -> list[OccError]:
    """Record the errors of the model that are created from now on, on any thread."""
    noted: list[OccError] = []
    make = OccError.__init__

    def note(error: OccError, *args: object, **more: object) -> None:
        make(error, *args, **more)  # type: ignore[arg-type]
        noted.append(error)

    monkeypatch.setattr(OccError, "__init__", note)
    return noted


@pytest.fixture
def stage(
    own_preset: None,
    application: Application,
    user: User,
    qtbot: QtBot,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> Stage:
    return Stage(application, user, qtbot, FileDialogs(monkeypatch), tmp_path)


def test_every_class_has_a_case() -> None:
    check_that_all_have_a_case(dict(CASES), NOT_IN_THE_WINDOW)


def picture_stays(application: Application, last: Snapshot) -> bool:
    """Whether the picture shown is the last one that could be made, by a sample of its pixels."""
    image = application.view("picture")
    picture = last.frame.picture(image.picture_kind)
    rows, columns = picture.shape
    places = [(row, column) for row in range(0, rows, 19) for column in range(0, columns, 23)]
    return all(
        image.simulation.level_at(column, row) == picture[row, column] for row, column in places
    )


@pytest.mark.own_window  # whose list of presets has the one that is made for it
def test_every_class_becomes_a_sentence_and_the_picture_stays(
    stage: Stage, raised: list[OccError], small_scene: Scene, caplog: pytest.LogCaptureFixture
) -> None:
    application, pictures = stage.application, list[Snapshot]()
    application.simulation.snapshot_shown.connect(pictures.append)
    for number, (error, case) in enumerate(CASES.items()):
        application.scene_store.put(small_scene.replace(code=number), "another code")
        stage.user.wait_until_idle()
        raised.clear()
        shown = case(stage)
        errors = [each for each in raised if type(each) is error]
        assert errors, f"no {error.__name__}, but {raised}, and the window says: {shown!r}"
        words = {say(each) for each in errors for say in (str, sentence_with_label, refusal_of)}
        assert shown in words, error
        assert shown.isprintable()
        assert shown.endswith("."), error
        assert pictures[-1].request.scene.transmitter.code == number
        assert picture_stays(application, pictures[-1]), error
    assert caplog.records == []


def line_of(row: ParameterRow) -> QLineEdit | None:
    """Return the field that a value is typed into, None where there is a list to choose from."""
    if isinstance(row, QuantityRow | CountRow):
        return row.field.lineEdit()
    return row.field if isinstance(row, PatternRow) else None


def lines_and_notices(application: Application) -> dict[str, tuple[QLineEdit, QLabel]]:
    """Find the fields that values are typed into, and where they say what is wrong."""
    code = application.controls.code
    found: dict[str, tuple[QLineEdit, QLabel]] = {"code": (code.number.lineEdit(), code.notices[0])}
    for panel in application.controls.panels.values():
        for name, row in panel.rows.items():
            line = line_of(row)
            if line is not None:
                found[name] = (line, row.notice)
    return found


def test_every_wrong_value_is_refused_at_its_field_with_unit_and_range(
    stage: Stage, small_scene: Scene
) -> None:
    fields = lines_and_notices(stage.application)
    not_typed = {name for name, each in PARAMETERS.items() if isinstance(each, Choice)}
    assert fields.keys() == PARAMETERS.keys() - not_typed
    kept = ChipPattern | Payload | CanonicalText
    for name, text in WRONG:
        if name in not_typed:
            continue
        declared, (line, notice) = PARAMETERS[name], fields[name]
        if name == "code":  # at most what the scene's bits can express
            assert isinstance(declared, Count)
            declared = replace(declared, high=2**small_scene.transmitter.bits - 1)
        last = line.text()
        line.setText(text)
        line.textEdited.emit(text)
        stage.qtbot.keyClick(line, Qt.Key.Key_Return)
        label = f"{declared.label[:1].upper()}{declared.label[1:]}"
        check_sentence(notice.text(), declared, text, f"{label} cannot be ")
        assert stage.user.message == notice.text()
        # Text that takes long to type stays until it is corrected.
        assert line.text() == (text if isinstance(declared, kept) else last)
    assert stage.application.scene_store.scene == small_scene

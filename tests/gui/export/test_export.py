"""Figures of what is shown, in files that open again, and never half of one."""

import sys
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from gui.user import User
from model.figures.artists import cut_off
from PIL import Image
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.detection_map.map_controller import MapRequest
from occ_gui.detection_map.map_schedule import SHAPE
from occ_gui.detection_map.rate_map import RateMap, lattice
from occ_gui.export import jobs
from occ_gui.values.placement import MODES
from occ_model.figures import drawing
from occ_model.results.accuracy import AccuracyPoint
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.provenance import ENDINGS, scene_inside
from occ_model.scene.scene import Scene


@pytest.fixture
def small_scene() -> Scene:
    """Give a scene whose picture is written as a table in a moment."""
    return occ.load_preset("phone-68us").replace(rows=120, columns=1728)


FIGURES = ("picture", "profile", "decoding-threshold", "decoding-matched")
"""What there is to export when a window has been opened."""


def export(application: Application, user: User, name: str, path: Path) -> str:
    application.shell.pane("export").export(name, path)
    user.wait_until_idle()
    return str(user.message)


def test_an_export_holds_its_scene(application: Application, user: User, tmp_path: Path) -> None:
    for name, ending in zip(FIGURES, ENDINGS, strict=True):
        path = tmp_path / f"{name}{ending}"
        assert export(application, user, name, path) == f"Exported {path.name} into {tmp_path}"
        assert scene_inside(path) == application.store.scene
    assert len(list(tmp_path.iterdir())) == len(ENDINGS)


def test_the_accuracy_plot_is_exported_once_it_is_measured(
    application: Application, user: User, tmp_path: Path
) -> None:
    path = tmp_path / "accuracy.csv"
    assert "not measured yet" in export(application, user, "accuracy", path)
    assert not path.exists()
    plot = application.view("accuracy").plot
    plot.show_study_begun()
    plot.show_point(AccuracyPoint("noise", "exact", 0.125, 0.25, current=True), 1, 1)
    plot.show_study_finished()
    assert export(application, user, "accuracy", path) == f"Exported accuracy.csv into {tmp_path}"
    assert "noise,exact,125.0,0.25,1" in path.read_text(encoding="utf-8")
    user.enter("iso", "200")
    assert "not measured yet" in export(application, user, "accuracy", path)


def test_the_map_is_exported_once_it_is_complete(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "map.csv"
    assert "not complete yet" in export(application, user, "map", path)
    scene, settings = application.store.scene, application.settings.settings
    x, y = "switching_frequency", "distance"
    rates = RateMap(x, y, lattice(x, SHAPE[0]), lattice(y, SHAPE[1]), ("threshold",))
    rates.enter([SweepPoint(index, 10, (4,), "", (0,)) for index in range(rates.images.size)], 2)
    asked = MapRequest(scene, x, y, settings, with_image_effects=False)
    map_pane = type(application.shell.pane("map").map)
    monkeypatch.setattr(map_pane, "full", property(lambda _: (rates, asked)))
    assert export(application, user, "map", path) == f"Exported map.csv into {tmp_path}"
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    assert len(lines) == 1 + rates.images.size
    assert lines[1].startswith("500.0,0.2,threshold,4,10,40.0,")
    assert scene_inside(path) == scene
    assert (
        export(application, user, "map", tmp_path / "map.png")
        == f"Exported map.png into {tmp_path}"
    )


def test_the_photo_is_drawn_beside_the_simulation(
    application: Application, user: User, photo_file: Path, tmp_path: Path
) -> None:
    export(application, user, "profile", tmp_path / "alone.csv")
    application.open_photo(photo_file)
    user.wait_until_idle()
    export(application, user, "profile", tmp_path / "both.csv")
    headers = [
        next(line for line in (tmp_path / name).read_text().splitlines() if line[0] != "#")
        for name in ("alone.csv", "both.csv")
    ]
    assert ["photo" in header for header in headers] == [False, True]


def test_the_difference_is_exported_as_it_is_seen(
    application: Application, user: User, photo_file: Path, tmp_path: Path
) -> None:
    application.open_photo(photo_file)
    user.wait_until_idle()
    application.options.choose_overlay("difference")
    path = tmp_path / "difference.csv"
    assert export(application, user, "picture", path) == f"Exported difference.csv into {tmp_path}"
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    photo = application.shell.pane("photo").matching.photo
    assert photo is not None
    rows, columns = photo.image.shape
    assert len(lines) == 1 + rows
    assert len(lines[0].split(",")) == 1 + columns
    assert "difference from the photo" in path.read_text(encoding="utf-8")


@pytest.mark.whole
def test_all_figures_go_into_a_folder_in_all_formats_with_scene_settings_version_and_date(
    application: Application, user: User, tmp_path: Path
) -> None:
    folder = tmp_path / "new" / "report"
    application.shell.pane("export").export_all(folder)
    user.wait_until_idle()
    assert {path.name for path in folder.iterdir()} == {
        f"{name}{ending}" for name in (*FIGURES, "bands", "flicker") for ending in ENDINGS
    }
    assert {scene_inside(path) for path in folder.iterdir()} == {application.store.scene}
    for table in folder.glob("*.csv"):
        text = table.read_text(encoding="utf-8")
        for noted in (f"occ_model {occ.__version__}", "seed 1", "tolerance 0.5", "date 20"):
            assert noted in text
    assert "Exported 24 files" in user.message
    assert "Left out: Accuracy and time" in user.message


def test_a_figure_is_copied_with_its_scene(application: Application, user: User) -> None:
    user.choose("Copy fi&gure")
    image = QGuiApplication.clipboard().image()
    assert min(image.width(), image.height()) > 200
    assert "occ_model" in image.text("Description")
    assert user.message == "Copied the figure."


def test_the_copied_figure_is_that_of_the_pane_in_front(
    application: Application, user: User, qtbot: QtBot
) -> None:
    application.view("profile").enhanced.setFocus()
    qtbot.waitUntil(lambda: application.current_pane.name == "profile")
    user.choose("Copy fi&gure")
    assert "Column profile" in QGuiApplication.clipboard().image().text("Title")
    application.view("decode").decoders.setCurrentIndex(1)
    application.view("decode").decoders.setFocus()
    user.choose("Copy fi&gure")
    assert "matched" in QGuiApplication.clipboard().image().text("Title")


def test_a_dropped_figure_restores_its_scene_as_one_step(
    application: Application, user: User, tmp_path: Path
) -> None:
    user.enter("distance", "2 m")
    shown = application.store.scene
    export(application, user, "profile", tmp_path / "figure.png")
    user.enter("distance", "3 m")
    before = application.store.scene
    application.window.dropped.emit([tmp_path / "figure.png"])
    user.wait_until_idle()
    assert application.store.scene == shown
    assert user.message == "Opened the scene inside figure.png"
    application.store.undo_stack.undo()
    assert application.store.scene == before


def test_a_picture_without_a_scene_inside_is_opened_as_a_photo(
    application: Application, user: User, photo_file: Path
) -> None:
    application.window.dropped.emit([photo_file])
    user.wait_until_idle()
    assert application.view("picture").photo.isVisible()


def test_what_is_not_there_or_no_figure_is_refused_in_a_sentence(
    application: Application, user: User, tmp_path: Path
) -> None:
    folder = tmp_path / "missing"
    for ending in ENDINGS:
        assert str(folder) in export(application, user, "profile", folder / f"f{ending}")
        rubbish = tmp_path / f"rubbish{ending}"
        rubbish.write_bytes(b"\0no figure")
        application.files.open_scene(rubbish)
        assert user.message.endswith(".")
        assert "rubbish" in user.message


def test_an_unknown_ending_is_refused(application: Application, user: User, tmp_path: Path) -> None:
    assert ".png, .svg, .pdf, .csv" in export(application, user, "profile", tmp_path / "f.docx")
    assert list(tmp_path.iterdir()) == []


def test_a_disk_full_midway_leaves_no_part_of_any_figure(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written: list[Path] = []
    write = Path.write_bytes

    def full(path: Path, content: bytes) -> int:
        written.append(path)
        if len(written) > 5:
            write(path, content[:10])
            raise OSError(28, "No space left on device")
        return write(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    folder = tmp_path / "report"
    application.shell.pane("export").export_all(folder)
    user.wait_until_idle()
    assert "No space left on device" in user.message
    assert len(written) > 5
    assert not folder.exists()
    application.shell.pane("export").export("profile", tmp_path / "one.pdf")
    user.wait_until_idle()
    assert "No space left on device" in user.message
    assert list(tmp_path.iterdir()) == []


def test_a_write_protected_figure_stops_the_export_of_all_before_any_is_drawn(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[object] = []
    monkeypatch.setattr(drawing, "write_all", lambda *asked: begun.append(asked) or [])
    files = sorted(tmp_path / f"{name}{ending}" for name in FIGURES for ending in ENDINGS)
    for file in files:
        file.write_bytes(b"kept")
    files[-1].chmod(0o444)
    application.shell.pane("export").export_all(tmp_path)
    user.wait_until_idle()
    assert f"{files[-1].name} is write-protected" in user.message
    assert {file: file.read_bytes() for file in tmp_path.iterdir()} == dict.fromkeys(files, b"kept")
    assert begun == []


def test_a_figure_that_is_write_protected_meanwhile_stops_the_export_of_all(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    last = tmp_path / f"{max(FIGURES)}.svg"

    def protect_and_write(aside: Path, *_asked: object) -> list[Path]:
        last.write_bytes(b"kept")
        last.chmod(0o444)
        written = [aside / name for name in ("a.svg", last.name)]
        for path in written:
            path.write_bytes(b"new")
        return written

    monkeypatch.setattr(drawing, "write_all", protect_and_write)
    application.shell.pane("export").export_all(tmp_path)
    user.wait_until_idle()
    assert f"{last.name} is write-protected" in user.message
    assert {file: file.read_bytes() for file in tmp_path.iterdir()} == {last: b"kept"}


def test_an_error_while_drawing_is_a_sentence_and_exports_go_on(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_job: object) -> None:
        raise ZeroDivisionError("a mistake")

    with monkeypatch.context() as patched:
        patched.setattr("occ_gui.export.export_controller.export", broken)
        messages = export(application, user, "profile", tmp_path / "a.png")
    assert messages == "The export failed: ZeroDivisionError: a mistake."
    assert (
        export(application, user, "profile", tmp_path / "a.png")
        == f"Exported a.png into {tmp_path}"
    )


def test_exports_that_come_quickly_are_all_written(
    application: Application, user: User, tmp_path: Path
) -> None:
    paths = [tmp_path / f"{place}.csv" for place in range(4)]
    for path in paths:
        application.shell.pane("export").export("profile", path)
    user.wait_until_idle()
    assert sorted(tmp_path.iterdir()) == paths


@pytest.mark.parametrize(
    ("chosen", "kind", "written"),
    [
        ("figure", "PDF document (*.pdf)", "figure.pdf"),
        ("figure.svg", "PNG picture (*.png)", "figure.svg"),
        ("figure", "", "figure.png"),
    ],
)
def test_the_ending_comes_from_the_name_or_the_chosen_format(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    chosen: str, kind: str, written: str,
) -> None:  # fmt: skip
    answer = (str(tmp_path / chosen), kind)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: answer)
    application.window.actions_by_name["export_profile"].trigger()
    user.wait_until_idle()
    assert [path.name for path in tmp_path.iterdir()] == [written]
    if written.endswith(".png"):
        with Image.open(tmp_path / written) as image:
            assert image.width > 500


def test_the_dialog_begins_with_the_format_of_the_last_export(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    application.shell.pane("export").export("profile", tmp_path / "other.csv")  # not chosen there
    user.wait_until_idle()
    begun: list[tuple[str, str]] = []

    def choose(_window: object, _title: str, path: str, _kinds: str, kind: str) -> tuple[str, str]:
        begun.append((Path(path).name, kind))
        return str(tmp_path / "figure"), "PDF document (*.pdf)"

    monkeypatch.setattr(QFileDialog, "getSaveFileName", choose)
    for _ in range(2):
        application.window.actions_by_name["export_profile"].trigger()
        user.wait_until_idle()
    assert begun == [
        ("profile.png", "PNG picture (*.png)"),
        ("profile.pdf", "PDF document (*.pdf)"),
    ]


def test_the_drawing_is_done_off_the_windows_thread(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from PySide6.QtCore import QThread

    threads: list[bool] = []
    work = jobs.export

    def note(job: jobs.ExportJob) -> jobs.Exported:
        threads.append(QThread.currentThread() is application.thread())
        return work(job)

    monkeypatch.setattr("occ_gui.export.export_controller.export", note)
    export(application, user, "profile", tmp_path / "a.csv")
    assert threads == [False]
    assert "matplotlib" in sys.modules


def test_the_picture_with_the_photo_has_an_entry_of_its_own(
    application: Application, user: User, tmp_path: Path, photo_file: Path
) -> None:
    entry = user.entry("Overlay of photo and picture")
    assert not entry.isEnabled()
    path = tmp_path / "both.png"
    assert export(application, user, "overlay", path).startswith("No photo is open")
    application.open_photo(photo_file)
    user.wait_until_idle()
    assert entry.isEnabled()
    files = []
    for mode in ("beside", "blend"):
        application.options.choose_overlay(mode)
        assert export(application, user, "overlay", path).startswith("Exported both.png")
        files.append(path.read_bytes())
        assert export(application, user, "picture", path).startswith("Exported both.png")
        files.append(path.read_bytes())
    over, beside, over_again, blended = (np.asarray(Image.open(BytesIO(f))) for f in files)
    assert over.shape == over_again.shape == blended.shape != beside.shape
    application.options.choose_overlay("beside")


@pytest.mark.whole
def test_no_text_of_an_exported_figure_is_cut_off_however_the_photo_is_shown(
    application: Application, user: User, tmp_path: Path, photo_file: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    cut: dict[str, list[str]] = {}
    mode = ""
    monkeypatch.setattr(
        drawing, "fit_texts", lambda figure: cut.setdefault(mode, []).extend(cut_off(figure))
    )
    long = tmp_path / f"{'A photo of the lamp in our laboratory, '.ljust(50)}, taken by me.png"
    long.write_bytes(photo_file.read_bytes())
    application.open_photo(long)
    user.wait_until_idle()
    for mode in MODES:
        application.options.choose_overlay(mode)
        for name in ("picture", "overlay", "profile"):
            said = export(application, user, name, tmp_path / f"{name}.svg")
            assert said.startswith("Exported"), said
    mode = "decoding"
    export(application, user, "decoding-threshold", tmp_path / "decoding.svg")
    assert cut == {mode: [] for mode in (*MODES, "decoding")}
    application.options.choose_overlay(MODES[0])

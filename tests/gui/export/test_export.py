"""Figures are exported to files that can be opened again, each complete or not at all."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from threading import Event, Timer
from typing import Any, NoReturn

import pytest
from gui.pane_bench import PaneBench
from gui.photo.photo_bench import no_actions
from gui.user import PATIENCE_S
from PIL import Image
from PySide6.QtCore import QThread
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.panes import accuracy, bands, decoding, detection_map, photo, picture, profile
from occ_gui.detection_map.map_schedule import SHAPE, MapRequest
from occ_gui.detection_map.rate_map import RateMap, make_lattice
from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.shell.feature import Draw, Feature, Figure, Pane
from occ_model.figures import drawing
from occ_model.figures.drawing import Drawing
from occ_model.results.accuracy import AccuracyPoint
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.provenance import ENDINGS, Provenance, scene_inside
from occ_model.scene.scene import Scene


@pytest.fixture
def small_scene() -> Scene:
    """Return a scene with a picture that is quickly written as a table."""
    return occ.load_preset("phone-68us").replace(rows=120, columns=1728)


FIGURES = ("picture", "profile", "decoding-threshold", "decoding-matched")
"""The figures that can be exported when a window has just been opened."""


class Bench(PaneBench):
    """The panes with figures, and a photo that can be opened."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        scenes, store, results_store = self.scenes, self.store, self.results_store
        self.photos = PhotoController(store, results_store)
        self.files = FileController(
            self.window, scenes, self.photos, Preferences(None), lambda use: None
        )
        for said in (self.files.status_message, self.files.failed):
            said.connect(self.said.append)
        image = self.add(picture(store, str)).view
        self.profile = self.add(profile(store, results_store, str)).view
        for feature in (
            decoding(store), accuracy(scenes, self.simulation), bands(scenes),
            detection_map(scenes, self.background_rates),
            photo(scenes, self.photos, lambda: image, results_store, no_actions()),
        ):  # fmt: skip
            self.shell.add(feature, self.window)
        self.simulate()

    def open(self, path: Path) -> None:
        self.see("photo")
        self.photos.open(path)
        self.wait_until_idle()

    def copy(self) -> QImage:
        self.exporter.copy_current()
        self.wait_until_idle()
        return QGuiApplication.clipboard().image()

    def stop(self) -> None:
        super().stop()
        self.background_rates.stop()
        self.photos.loading.task.stop()

    def lay_over(self, mode: str) -> None:
        self.store.put(replace(self.store.workspace, overlay=mode))


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch) -> Bench:
    # A tenth of the pixels, and a quarter of the time; how texts fit the page is tested elsewhere.
    monkeypatch.setitem(drawing.STYLE, "figure.dpi", 60)
    monkeypatch.setitem(drawing.STYLE, "figure.constrained_layout.use", False)
    return Bench(qtbot, small_scene)


def test_an_export_holds_its_scene(bench: Bench, tmp_path: Path) -> None:
    for name, ending in zip(FIGURES, ENDINGS, strict=True):
        path = tmp_path / f"{name}{ending}"
        assert bench.export(name, path) == f"Exported {path.name} into {tmp_path}"
        assert scene_inside(path) == bench.scenes.scene
    assert len(list(tmp_path.iterdir())) == len(ENDINGS)


def test_the_accuracy_plot_is_exported_once_it_is_measured(bench: Bench, tmp_path: Path) -> None:
    path = tmp_path / "accuracy.csv"
    assert "not measured yet" in bench.export("accuracy", path)
    assert not path.exists()
    plot = bench.shell.pane("accuracy").view.plot
    plot.show_study_begun()
    plot.show_point(AccuracyPoint("draft", "exact", 0.125, 0.25, current=True), 1, 1)
    plot.show_study_finished()
    assert bench.export("accuracy", path) == f"Exported accuracy.csv into {tmp_path}"
    assert "draft,exact,125.0,0.25,1" in path.read_text(encoding="utf-8")
    bench.simulate(iso=200.0)
    assert "not measured yet" in bench.export("accuracy", path)


def test_the_map_is_exported_once_it_is_complete(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "map.csv"
    assert "not complete yet" in bench.export("map", path)
    scene, settings = bench.scenes.scene, bench.settings.settings
    x, y = "switching_frequency", "distance"
    rates = RateMap(x, y, make_lattice(x, SHAPE[0]), make_lattice(y, SHAPE[1]), ("threshold",))
    rates.enter([SweepPoint(index, 10, (4,), "", (0,)) for index in range(rates.images.size)], 2)
    asked = MapRequest(scene, x, y, settings, with_image_effects=False)
    map_pane = type(bench.shell.pane("map").map)
    monkeypatch.setattr(map_pane, "complete", property(lambda _: (rates, asked)))
    assert bench.export("map", path) == f"Exported map.csv into {tmp_path}"
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    assert len(lines) == 1 + rates.images.size
    assert lines[1].startswith("500.0,0.2,threshold,4,10,40.0,")
    assert scene_inside(path) == scene
    assert bench.export("map", tmp_path / "map.png") == f"Exported map.png into {tmp_path}"


def test_the_photo_is_drawn_beside_the_simulation_and_the_difference_as_it_is_seen(
    bench: Bench, photo_file: Path, tmp_path: Path
) -> None:
    bench.export("profile", tmp_path / "alone.csv")
    bench.open(photo_file)
    bench.export("profile", tmp_path / "both.csv")
    headers = [
        next(line for line in (tmp_path / name).read_text().splitlines() if line[0] != "#")
        for name in ("alone.csv", "both.csv")
    ]
    assert ["photo" in header for header in headers] == [False, True]
    bench.lay_over("difference")
    path = tmp_path / "difference.csv"
    assert bench.export("picture", path) == f"Exported difference.csv into {tmp_path}"
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    photo = bench.results_store.results.photo
    rows, columns = photo.image.shape
    assert len(lines) == 1 + rows
    assert len(lines[0].split(",")) == 1 + columns
    assert "difference from the photo" in path.read_text(encoding="utf-8")


@pytest.mark.whole
def test_all_figures_go_into_a_folder_in_all_formats_with_scene_settings_version_and_date(
    bench: Bench, tmp_path: Path
) -> None:
    folder = tmp_path / "new" / "report"
    bench.exporter.export_all(folder)
    bench.wait_until_idle()
    assert {path.name for path in folder.iterdir()} == {
        f"{name}{ending}" for name in (*FIGURES, "bands", "flicker") for ending in ENDINGS
    }
    assert {scene_inside(path) for path in folder.iterdir()} == {bench.scenes.scene}
    for table in folder.glob("*.csv"):
        text = table.read_text(encoding="utf-8")
        for noted in (f"occ_model {occ.__version__}", "seed 1", "tolerance 0.5", "date 20"):
            assert noted in text
    assert "Exported 24 files" in bench.said[-1]
    assert "Left out: Accuracy and time" in bench.said[-1]


def test_the_figure_of_the_pane_in_front_is_copied_with_its_scene(
    bench: Bench, qtbot: QtBot
) -> None:
    image = bench.copy()
    assert min(image.width(), image.height()) > 60
    assert "occ_model" in image.text("Description")
    assert bench.said[-1] == "Copied the figure."
    assert "picture" in image.text("Title")
    bench.see("decode")
    decoders = bench.shell.pane("decode").view.decoders
    decoders.setCurrentIndex(1)
    decoders.setFocus()
    qtbot.waitUntil(decoders.hasFocus)
    assert "matched" in bench.copy().text("Title")


def test_a_dropped_figure_restores_its_scene_as_one_step_and_one_without_is_a_photo(
    bench: Bench, tmp_path: Path, photo_file: Path
) -> None:
    bench.simulate(distance=2.0)
    shown = bench.scenes.scene
    bench.export("profile", tmp_path / "figure.png")
    bench.simulate(distance=3.0)
    before = bench.scenes.scene
    bench.files.open_dropped([tmp_path / "figure.png"])
    assert bench.scenes.scene == shown
    assert bench.said[-1] == "Opened the scene inside figure.png"
    bench.scenes.undo_stack.undo()
    assert bench.scenes.scene == before
    bench.see("photo")
    bench.files.open_dropped([photo_file])
    bench.wait_until_idle()
    assert bench.shell.pane("picture").view.photo.isVisible()


def test_what_is_not_there_no_figure_or_of_another_ending_is_refused_in_a_sentence(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, drawn = tmp_path / "missing", list[object]()
    for ending in ENDINGS:
        with monkeypatch.context() as patched:  # it takes a second, and is known before
            patched.setattr(drawing.Drawing, "write", lambda *asked: drawn.append(asked))
            assert str(folder) in bench.export("profile", folder / f"f{ending}")
        rubbish = tmp_path / f"rubbish{ending}"
        rubbish.write_bytes(b"\0no figure")
        bench.files.open_scene(rubbish)
        assert bench.said[-1].endswith(".")
        assert "rubbish" in bench.said[-1]
    assert drawn == []
    assert ".png, .svg, .pdf or .csv" in bench.export("profile", tmp_path / "f.docx")
    assert not (tmp_path / "f.docx").exists()


def test_a_disk_full_midway_leaves_no_part_of_any_figure(
    qtbot: QtBot, small_scene: Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = PaneBench(qtbot, small_scene)  # with two figures
    bench.add(decoding(bench.store))
    bench.simulate()
    written: list[Path] = []
    write = Path.write_bytes
    monkeypatch.setattr(drawing, "ENDINGS", endings := (".csv",))

    def full(path: Path, content: bytes) -> int:
        written.append(path)
        if len(written) > len(endings):  # all of one figure, and a part of the next
            write(path, content[:10])
            raise OSError(28, "No space left on device")
        return write(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    folder = tmp_path / "report"
    bench.exporter.export_all(folder)
    bench.wait_until_idle()
    assert "No space left on device" in bench.said[-1]
    assert len(written) > len(endings)
    assert not folder.exists()
    assert "No space left on device" in bench.export("decoding-threshold", tmp_path / "one.csv")
    assert list(tmp_path.iterdir()) == []


def test_a_window_that_is_closed_ends_the_export_of_all_figures_and_no_part_stays(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, go_on, texts = Event(), Event(), list[str]()
    table_text = drawing.table_text

    def wait(*asked: Any) -> str:
        begun.set()
        assert go_on.wait(PATIENCE_S)
        texts.append(table_text(*asked))
        return texts[-1]

    monkeypatch.setattr(drawing, "table_text", wait)
    monkeypatch.setattr(drawing, "ENDINGS", (".csv",))
    folder = tmp_path / "report"
    bench.exporter.export_all(folder)
    assert begun.wait(PATIENCE_S)
    assert folder.exists()
    Timer(0.1, go_on.set).start()
    bench.exporter.stop()
    assert len(texts) == 1
    assert not folder.exists()


def test_a_write_protected_figure_stops_the_export_of_all_before_any_is_drawn(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[object] = []
    monkeypatch.setattr(Drawing, "encode", lambda *asked: begun.append(asked))
    files = sorted(tmp_path / f"{name}{ending}" for name in FIGURES for ending in ENDINGS)
    for file in files:
        file.write_bytes(b"kept")
    files[-1].chmod(0o444)
    bench.exporter.export_all(tmp_path)
    bench.wait_until_idle()
    assert f"{files[-1].name} is write-protected" in bench.said[-1]
    assert {file: file.read_bytes() for file in tmp_path.iterdir()} == dict.fromkeys(files, b"kept")
    assert begun == []


def add_figure(bench: Bench, draw: Draw) -> None:
    """Add a pane whose figure is drawn by this function."""
    figure = Figure(name="own", title="Own", draw=lambda _pane, _snapshot: draw)
    bench.add(Feature(name="own", title="Own", make=lambda: Pane(QWidget()), figures=(figure,)))


def test_an_error_while_drawing_is_a_sentence_and_exports_go_on(
    bench: Bench, tmp_path: Path
) -> None:
    def fail() -> NoReturn:
        raise ZeroDivisionError("a mistake")

    add_figure(bench, fail)
    message = bench.export("own", tmp_path / "a.png")
    assert message == "The export failed: ZeroDivisionError: a mistake."
    assert bench.export("profile", tmp_path / "a.png") == f"Exported a.png into {tmp_path}"


def test_the_ending_is_the_names_or_that_of_the_format_with_which_the_next_dialog_begins(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench.exporter.export("profile", tmp_path / "other.csv")  # not chosen there
    bench.wait_until_idle()
    begun: list[tuple[str, str]] = []

    answers = iter([("figure", "PDF document (*.pdf)"), ("figure.csv", "PNG picture (*.png)")])

    def choose(_window: object, _title: str, path: str, _kinds: str, kind: str) -> tuple[str, str]:
        begun.append((Path(path).name, kind))
        name, chosen = next(answers)
        return str(tmp_path / name), chosen

    monkeypatch.setattr(QFileDialog, "getSaveFileName", choose)
    for _ in range(2):
        bench.exporter.ask("profile")
        bench.wait_until_idle()
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {"other.csv", "figure.pdf", "figure.csv"}
    assert begun == [
        ("profile.png", "PNG picture (*.png)"),
        ("profile.pdf", "PDF document (*.pdf)"),
    ]


def test_a_file_can_be_named_before_there_is_a_picture(
    qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    panes, asked = PaneBench(qtbot, small_scene), list[object]()
    panes.add(decoding(panes.store))
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *a: asked.append(a) or ("", ""))
    panes.exporter.ask("decoding-threshold")
    assert len(asked) == 1


def test_the_drawing_is_done_off_the_windows_thread_and_exports_that_come_quickly_are_all_written(
    bench: Bench, tmp_path: Path
) -> None:
    threads: list[bool] = []
    draw_profile = bench.shell.draw("profile", bench.simulate())

    def note_and_draw() -> Drawing:
        threads.append(QThread.currentThread() is bench.window.thread())
        return draw_profile()

    add_figure(bench, note_and_draw)
    paths = [tmp_path / f"{place}.csv" for place in range(4)]
    for path in paths:
        bench.exporter.export("own", path)
    bench.wait_until_idle()
    assert threads == [False] * 4
    assert sorted(tmp_path.iterdir()) == paths


def test_the_picture_with_the_photo_has_an_entry_of_its_own(
    bench: Bench, tmp_path: Path, photo_file: Path
) -> None:
    path = tmp_path / "both.png"
    assert bench.export("overlay", path).startswith("No photo is open")
    bench.open(photo_file)
    shapes = []
    for name, mode in (("overlay", "beside"), ("picture", "blend"), ("picture", "beside")):
        bench.lay_over(mode)
        assert bench.export(name, path).startswith("Exported both.png")
        with Image.open(path) as picture:
            shapes.append(picture.size)
    over, blended, beside = shapes
    assert over == blended != beside


def test_each_figure_says_where_it_comes_from_and_nothing_temporary_stays(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def write(
        folder: Path, drawings: Iterable[Drawing], provenance: Callable[[Drawing], Provenance]
    ) -> list[Path]:
        written = []
        for drawn in drawings:
            (path := folder / f"{drawn.name}.svg").write_text(provenance(drawn).title, "utf-8")
            written.append(path)
        return written

    monkeypatch.setattr(drawing, "write_all", write)
    bench.exporter.export_all(tmp_path)
    bench.wait_until_idle()
    first_words = {
        file.name: file.read_text(encoding="utf-8").split()[0] for file in tmp_path.iterdir()
    }
    assert first_words == {
        "picture.svg": "Camera's", "profile.svg": "Column", "decoding-threshold.svg": "Decoding,",
        "decoding-matched.svg": "Decoding,", "bands.svg": "Least", "flicker.svg": "Flicker",
    }  # fmt: skip
    assert "No photo" not in bench.said[-1]  # its figure is no other one without a photo

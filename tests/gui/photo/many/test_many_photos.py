"""Several photos: their rows, the mean, lines to paste, and cancelling."""

import threading
from collections.abc import Callable, Generator
from dataclasses import replace
from pathlib import Path

import pytest
from gui.kinds import add_widget, collect
from gui.photo.photo_bench import PhotoBench
from gui.user import PATIENCE_S
from matches import match_with
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QToolButton
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo.many.many_controller import ManyPhotosController
from occ_gui.photo.many.many_view import ManyPhotosView
from occ_gui.photo.many.rows_model import ESTIMATE, EXPOSURE, KNOWN, NOTE, PHOTO, VERDICT
from occ_gui.values.choices import LoadOptions, MatchChoice
from occ_gui.values.photo_results import ListedRows, MatchOutcome
from occ_model.photo.many import match_photos
from occ_model.photo.many.other_programs import format_lines
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.many.table import table_of
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match
from occ_model.results.photo_table import PhotoRow, PhotoTable, csv_text
from occ_model.scene.parameters import quantity

PATHS = tuple(Path(f"photo-{number}.jpg") for number in range(6))


def match_of_readout(readout: float, *doubts: str) -> Match:
    return match_with(
        readout_time=readout, exposure_time=8e-5, correlation=0.98765, exposure_reasons=doubts,
        uncertainties={"readout_time": 2e-9, "exposure_time": 4e-7},
    )  # fmt: skip


def row(path: Path, readout: float = 7e-6, verdict: str = "sure", note: str = "") -> PhotoRow:
    return PhotoRow(
        path, verdict, note, match_of_readout(readout), noted_exposure=7.9e-5, lines=1000,
        size=(600, 1000), scanned_along="lines",
    )  # fmt: skip


ROWS = (
    row(PATHS[0]),
    row(PATHS[1], 7.001e-6),
    row(PATHS[2], 9e-6),
    row(PATHS[3], 5e-6, "doubtful", "Only 1.2 periods are in view."),
    PhotoRow(PATHS[4], "unreadable", "photo-4.jpg is an empty file."),
    row(PATHS[5], 6.999e-6),
)


def table() -> PhotoTable:
    return table_of(MatchSettings(occ.Scene()), ROWS)


GIVEN = ("switching_frequency", 1e4)


class Listed(PhotoBench):
    """Photos in a table that shows what is found in them."""

    def __init__(self, qtbot: QtBot) -> None:
        super().__init__()
        self.view = add_widget(qtbot, ManyPhotosView())
        self.view.resize(420, 500)
        self.follow(self.view.show_photo)
        self.photos.list_files(PATHS)

    def put(self, listed: ListedRows) -> None:
        self.results_store.put(replace(self.results_store.results, listed=listed))

    def begin(self, rows: dict[int, PhotoRow] | None = None) -> None:
        """Begin to match the photos; some have their rows already."""
        settings = MatchSettings(occ.Scene())
        self.put(ListedRows(PATHS, rows or {}, LoadOptions(), GIVEN, settings, is_running=True))

    def show_table(self, table: PhotoTable) -> None:
        rows, settings = dict(enumerate(table.rows)), MatchSettings(table.scene)
        self.put(ListedRows(PATHS, rows, LoadOptions(), GIVEN, settings, table))

    def confirm(self, certain: dict[str, float]) -> None:
        self.choose(certain=certain)


@pytest.fixture
def listed(qtbot: QtBot) -> Listed:
    return Listed(qtbot)


@pytest.fixture
def view(listed: Listed) -> ManyPhotosView:
    return listed.view


def controller_of(listed: Listed) -> ManyPhotosController:
    """Make a controller of photos that are read along their lines, in green."""
    listed.choose(load_options=LoadOptions("lines", "green"))
    return ManyPhotosController(
        listed.scenes, listed.photos, listed.view, listed.results_store, jobs=1
    )


CERTAIN = {"switching_frequency": occ.Scene().transmitter.switching_frequency}


def tip(view: ManyPhotosView, place: int, which: int) -> str:
    return str(view.rows.data(view.rows.index(place, which), Qt.ItemDataRole.ToolTipRole))


def column(view: ManyPhotosView, which: int) -> list[str]:
    return [view.rows.text(place, which) for place in range(len(PATHS))]


def test_without_files_nothing_can_be_matched_and_what_to_do_is_said(
    view: ManyPhotosView, listed: Listed
) -> None:
    assert view.start.isEnabled()
    assert view.table.columnWidth(PHOTO) == view.table.sizeHintForColumn(PHOTO)
    listed.photos.list_files(())
    assert not view.start.isEnabled()
    assert view.title.text().startswith("Open several photos together")


def test_before_the_match_the_header_says_what_must_be_known(
    view: ManyPhotosView, listed: Listed, qtbot: QtBot
) -> None:
    for change, known in (
        (lambda: listed.choose(form=MatchChoice("lamp")), "lamp_frequency"),
        (lambda: listed.choose(form=MatchChoice()), "switching_frequency"),
        (lambda: listed.scenes.change(light="lamp"), "lamp_frequency"),
        (lambda: listed.choose(form=MatchChoice(estimate="switching_frequency")), "readout_time"),
    ):
        with qtbot.waitSignal(view.rows.headerDataChanged):
            change()
        title = view.rows.headerData(KNOWN, Qt.Orientation.Horizontal)
        assert title == f"given {quantity(known).symbol}"


def test_each_photo_has_its_verdict_and_times_and_a_doubtful_exposure_says_so(
    view: ManyPhotosView,
    listed: Listed,
    photo: Photo,
) -> None:
    listed.show_table(table())
    assert column(view, PHOTO) == [path.name for path in PATHS]
    sure, unreadable = "● sure", "✕ unreadable"
    assert column(view, VERDICT) == [
        sure, sure, f"{sure}, outlier", "◐ doubtful", unreadable, sure,
    ]  # fmt: skip
    assert column(view, ESTIMATE)[0] == "7.0000 ± 0.0020 µs"
    assert column(view, EXPOSURE)[4] == ""
    assert column(view, NOTE)[3:5] == [ROWS[3].note, ROWS[4].note]
    rows = (replace(ROWS[0], match=match_of_readout(7e-6, "Few edges.")), *ROWS[1:])
    listed.show_table(table_of(MatchSettings(occ.Scene()), rows))
    assert column(view, VERDICT)[0] == "● sure"
    assert column(view, EXPOSURE)[:2] == ["80.00 ± 0.40 µs (doubtful)", "80.00 ± 0.40 µs"]
    listed.show_photo(replace(photo, path=PATHS[0]))
    listed.change(outcome=MatchOutcome(None, match_of_readout(7e-6), GIVEN))
    assert column(view, VERDICT)[:2] == ["● sure, earlier match", "● sure"]


def test_the_mean_is_that_of_the_model_and_named_by_the_frequency_that_it_rests_on(
    view: ManyPhotosView,
    listed: Listed,
) -> None:
    labels = (view.mean, view.exposure, view.frame)
    listed.show_table(table())
    assert all(": if f = 10 kHz: " in label.text() for label in labels)
    listed.confirm(CERTAIN)
    assert table().estimated.value == pytest.approx(7e-6)
    assert view.mean.text() == (
        "Readout time a line: 7.0000 ± 0.0018 µs, mean of 3 sure photos; χ² 0.5 of 2: they agree; "
        "1 left out"
    )
    assert view.exposure.text().startswith("Exposure time: 80.00 ± 0.40 µs, mean of 3 sure photos")
    assert view.frame.text() == "Readout of the whole frame, sure photos: 7.0000 ± 0.0018 ms"
    assert view.title.text() == "6 photos: 4 sure, 1 doubtful, 1 unreadable"


def test_another_frequency_asks_to_match_again_unless_that_of_the_photos_is_certain(
    view: ManyPhotosView,
    listed: Listed,
) -> None:
    listed.show_table(table())
    other = occ.Scene().replace(switching_frequency=4321.0)
    for scene, certain, is_stale in (
        (occ.Scene(), {}, False),
        (other, {}, True),
        (other, CERTAIN, False),
        (occ.Scene().replace(exposure_time=1e-4), {}, False),
    ):
        listed.scenes.put(scene, "scene")
        listed.confirm(certain)
        assert view.warning.isHidden() != is_stale
        if is_stale:
            assert "the scene has 4.321 kHz now: match all again." in view.warning.text()


def test_lines_for_other_programs_are_copied(
    view: ManyPhotosView, listed: Listed, qtbot: QtBot
) -> None:
    listed.confirm(CERTAIN)
    listed.show_table(table())
    assert list(view.paste.lines) == ["OpenDroneMap", "Gyroflow"]
    said = collect(view.copied)
    for button in view.findChildren(QToolButton):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
        copied = QGuiApplication.clipboard().text()
        assert copied in {f.text() for f in view.paste.lines.values()}
        assert said.pop() == f"Copied: {copied}"
    listed.begin()
    assert view.paste.lines == {}
    assert view.mean.isHidden()


def test_the_table_is_copied_and_saved_as_the_shell_has_it(
    view: ManyPhotosView, listed: Listed, qtbot: QtBot
) -> None:
    for button in (view.copy, view.save):
        assert not button.isEnabled()
    listed.show_table(table())
    said = collect(view.copied)
    for condition in ("if f = 10 kHz: ", ""):
        paste = format_lines(table(), condition)
        assert [line.split(":")[0] for line in paste[:2]] == ["OpenDroneMap", "Gyroflow"]
        assert paste[0].startswith(f"OpenDroneMap: {condition}")
        qtbot.mouseClick(view.copy, Qt.MouseButton.LeftButton)
        assert QGuiApplication.clipboard().text() == csv_text(table(), paste, condition)
        first = csv_text(table(), paste, condition).splitlines()[0]
        assert said.pop() == f"Copied: {first} …"
        with qtbot.waitSignal(view.save_asked) as saved:
            qtbot.mouseClick(view.save, Qt.MouseButton.LeftButton)
        assert saved.args == [csv_text(table(), paste, condition)]
        listed.confirm(CERTAIN)


def test_a_line_is_pasted_nowhere_while_its_frequency_is_only_assumed(
    view: ManyPhotosView, listed: Listed
) -> None:
    listed.show_table(table())
    assert not view.findChildren(QToolButton)
    assert "hold only if f = 10 kHz" in view.paste.reason.text()
    assert "hold only if f = 10 kHz" in view.title.text()
    assert all("if f = 10 kHz" in tip(view, 0, column) for column in (ESTIMATE, EXPOSURE))
    listed.confirm(CERTAIN)
    assert len(view.findChildren(QToolButton)) == 2
    assert view.paste.reason.isHidden()
    assert "if f" not in view.title.text() + tip(view, 0, ESTIMATE)
    listed.confirm({})
    listed.begin({0: ROWS[0]})
    assert "if f = 10 kHz" in view.title.text()
    assert view.work.progress.text() == "1 of 6"


def names_of_marked_photos(view: ManyPhotosView) -> list[str]:
    """Name the photos whose rows have the colours of a selection."""
    role = Qt.ItemDataRole.BackgroundRole
    chosen = view.table.selectionModel().selectedRows()
    rows = [n for n in range(len(PATHS)) if view.rows.data(view.rows.index(n, 0), role) is not None]
    return [view.rows.paths[n].name for n in {*rows, *(index.row() for index in chosen)}]


def test_a_click_on_a_row_opens_its_photo_which_is_marked_however_it_was_opened(
    view: ManyPhotosView, listed: Listed, photo: Photo, qtbot: QtBot
) -> None:
    view.show()
    place = view.table.visualRect(view.rows.index(2, PHOTO)).center()
    qtbot.mouseClick(view.table.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert names_of_marked_photos(view) == [], "it may be no photo"
    listed.show_photo(replace(photo, path=PATHS[2]))
    assert names_of_marked_photos(view) == [PATHS[2].name]
    listed.show_photo(replace(photo, path=PATHS[4]))
    qtbot.keyClick(view.table, Qt.Key.Key_Up)
    assert names_of_marked_photos(view) == [PATHS[4].name]
    listed.show_photo(replace(photo, path=Path("another.jpg")))
    assert names_of_marked_photos(view) == []
    with qtbot.waitSignal(view.photo_chosen) as chosen:
        view.table.clicked.emit(view.rows.index(2, VERDICT))
    assert chosen.args == [PATHS[2]]


def enter_known(view: ManyPhotosView, place: int, text: str) -> bool:
    return view.rows.setData(view.rows.index(place, KNOWN), text)


class Bench:
    """A controller, and a model that gives the rows above when it is let."""

    def __init__(self, listed: Listed, monkeypatch: pytest.MonkeyPatch) -> None:
        self.go_on, self.settings, self.closed = threading.Event(), [], threading.Event()  # type: ignore[var-annotated]
        monkeypatch.setattr(match_photos, "match_rows", self._rows)
        self.controller = controller_of(listed)

    def _rows(
        self,
        paths: tuple[Path, ...],
        settings: MatchSettings,
        jobs: int,
        beat: Callable[[], object],
    ) -> Generator[tuple[int, PhotoRow], None, None]:
        self.settings.append(settings)
        try:
            if len(paths) == 1:
                frequency = settings.scene.transmitter.switching_frequency
                found = replace(match_of_readout(7e-6), switching_frequency=frequency)
                yield 0, replace(row(paths[0]), match=found)
                return
            yield 0, ROWS[0]
            while not self.go_on.wait(0.01):
                beat()
            yield from list(enumerate(ROWS))[1 : len(paths)]
        finally:
            self.closed.set()

    def start(self, **choice: object) -> None:
        self.controller.start(MatchChoice(**choice))  # type: ignore[arg-type]


@pytest.fixture
def bench(listed: Listed, monkeypatch: pytest.MonkeyPatch) -> Generator[Bench, None, None]:
    bench = Bench(listed, monkeypatch)
    yield bench
    bench.go_on.set()
    bench.controller.task.stop()


def test_rows_appear_as_they_are_found_and_then_the_mean(
    bench: Bench, view: ManyPhotosView, qtbot: QtBot
) -> None:
    bench.start(sent="lamp", lamp_frequency=1000.0)
    qtbot.waitUntil(lambda: column(view, VERDICT)[0] == "● sure")
    assert column(view, VERDICT)[1:] == [""] * 5
    assert not view.start.isEnabled()
    with qtbot.waitSignal(bench.controller.task.finished):
        bench.go_on.set()
    (settings,) = bench.settings
    assert (settings.sent, settings.scan_axis, settings.channel) == ("auto", "lines", "green")
    assert (settings.scene.transmitter.light, settings.scene.transmitter.lamp_frequency) == (
        "lamp", 1e3,
    )  # fmt: skip
    assert bench.controller.listed.table.rows == ROWS
    assert view.mean.text()
    assert view.start.isEnabled()


def test_a_photo_of_another_lamp_is_matched_again_with_its_own_frequency(
    bench: Bench, view: ManyPhotosView, qtbot: QtBot
) -> None:
    assert enter_known(view, 5, "3 kHz")
    bench.go_on.set()
    with qtbot.waitSignal(bench.controller.task.finished):
        bench.start()
    assert bench.settings[0].known == ((5, 3e3),)
    assert column(view, KNOWN) == ["10 kHz"] * 5 + ["3 kHz"]
    with qtbot.waitSignal(bench.controller.task.finished) as found:
        assert enter_known(view, 2, "7")
        assert not view.start.isEnabled()
    (made,) = found.args
    assert [one.given for one in made.rows] == [None, None, 7e3, None, None, None]
    assert made.rows[2].switching_frequency == 7e3
    assert made.rows[:2] + made.rows[3:] == ROWS[:2] + ROWS[3:], "the others stay"
    assert column(view, KNOWN)[2] == "7 kHz"
    assert "if f" not in tip(view, 2, ESTIMATE)
    assert "if f = 10 kHz" in tip(view, 1, ESTIMATE)
    with qtbot.waitSignal(bench.controller.task.finished):
        assert enter_known(view, 2, "")
    assert column(view, KNOWN)[2] == "10 kHz"
    assert bench.controller.listed.table.rows[2].given is None


def test_a_frequency_that_cannot_be_stays_out_and_says_why(
    bench: Bench, view: ManyPhotosView, listed: Listed
) -> None:
    listed.show_table(table())
    for wrong in ("-3 kHz", "fast"):
        assert not enter_known(view, 1, wrong)
        assert wrong.split()[0] in view.notes.text()
    assert column(view, KNOWN)[1] == "10 kHz"
    assert column(view, VERDICT)[1] == "● sure", "what was found stays"
    assert bench.settings == []


def test_cancelling_ends_the_work_and_keeps_the_rows(
    bench: Bench, view: ManyPhotosView, qtbot: QtBot
) -> None:
    bench.start()
    qtbot.waitUntil(lambda: column(view, VERDICT)[0] == "● sure")
    view.cancelled.emit()
    assert bench.closed.wait(PATIENCE_S)
    assert column(view, VERDICT) == ["● sure"] + [""] * 5
    assert (view.start.isEnabled(), bench.controller.listed.table) == (True, None)
    assert view.mean.isHidden()


def test_other_files_cancel_the_work_on_the_first(bench: Bench, view: ManyPhotosView) -> None:
    bench.start()
    bench.controller.photos.list_files(PATHS[:2])
    bench.controller.forget_rows()
    assert bench.controller.task.is_idle
    assert view.rows.paths == PATHS[:2]


def test_a_failure_is_a_sentence_in_the_table(
    view: ManyPhotosView, listed: Listed, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    def fail(*_arguments: object) -> None:
        raise occ.MatchError("Nothing works.")

    monkeypatch.setattr(match_photos, "match_rows", fail)
    controller = controller_of(listed)
    controller.start(MatchChoice())
    qtbot.waitUntil(lambda: view.notes.text() == "Nothing works.")
    assert view.start.isEnabled()
    controller.task.stop()


def test_real_photos_are_matched_from_the_window(
    view: ManyPhotosView, listed: Listed, tmp_path: Path, qtbot: QtBot
) -> None:
    missing = tmp_path / "missing.jpg"
    controller = controller_of(listed)
    listed.photos.list_files((missing, missing))
    with qtbot.waitSignal(controller.task.finished) as found:
        controller.start(MatchChoice())
    (made,) = found.args
    assert [one.verdict for one in made.rows] == ["unreadable", "unreadable"]
    assert replace(made.rows[0], note="") == PhotoRow(missing, "unreadable")
    controller.task.stop()

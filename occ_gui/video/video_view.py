"""Pane of films: its bars, the film beside its simulation, what is read, and its timeline."""

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QTextCursor
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QMenu,
    QPlainTextEdit,
    QSizePolicy,
    QSplitter,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from occ_gui.video.camera import AXES, CameraDevice
from occ_gui.video.film_reading import FilmReading, MarkLegend, Marks
from occ_gui.video.frame_views import FilmPictures, FrameRows
from occ_gui.video.recording_form import RecordingForm
from occ_gui.video.timeline import Timeline
from occ_gui.widgets.answer import Answer
from occ_gui.widgets.building import (
    ElidedLabel,
    KeyedComboBox,
    ScrollPane,
    check_box,
    fill,
    name_widget,
    paragraph,
    push_button,
)
from occ_gui.widgets.icons import IconButton
from occ_gui.widgets.outdated_mark import OutdatedMark
from occ_gui.widgets.plain_text import in_menu, in_tool_tip
from occ_model.results.fact import Fact

_ICON = 16  # pixels

_MOST_TEXT = 200_000  # most characters of text that are shown, from its end

_LEAST_TEXT_HEIGHT = 40

_LEAST_PAGE = QSize(240, 80)

_LARGE_PICTURE_PERCENT = 80  # height of large pictures, in percent of the pane


class FilmBar(QWidget):
    open_asked = Signal()

    close_asked = Signal()  # the user closes the film, or stops the camera
    cameras_asked = Signal()  # the user wants to see which cameras there are

    camera_chosen = Signal(object)

    read_asked = Signal()  # the user begins to read the film, or stops it

    def __init__(self) -> None:
        super().__init__()
        tip = "Choose a film of a rolling-shutter camera."
        self.open = push_button("Open fil&m…", tip, self.open_asked)
        self.camera = push_button("Camera", "Read live from a camera of this computer.")
        self.cameras = QMenu(self.camera)
        self.camera.setMenu(self.cameras)
        self.cameras.aboutToShow.connect(self.cameras_asked)
        self.close_film = push_button("Close", do=self.close_asked)
        self.axis = KeyedComboBox(
            "What the shutter scans",
            "Whether the shutter scans the picture line by line or column by column.\n"
            "For a film, its first frames determine this; change it if it is wrong.",
            dict(zip(AXES, ("line by line", "column by column"), strict=True)),
            is_fixed=True,
        )
        self.lock = check_box("Lock exposure", "Keep the camera's exposure as it is now.")
        self.read = push_button("", do=self.read_asked)
        self.title = name_widget(ElidedLabel(), "Film")
        self.title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        left = (self.open, self.camera, self.axis, self.lock, self.close_film)
        buttons = fill(QHBoxLayout(), *left, None, self.read, margins=0)
        fill(QVBoxLayout(self), buttons, self.title, margins=0, spacing=4)
        self.show_film("", is_film=False, is_live=False)
        self.show_state(is_reading=False, is_read=False)

    def show_film(self, title: str, *, is_film: bool, is_live: bool) -> None:
        """Show what is open: a film, a camera, or else the simulated film."""
        self.title.set_full_text(title)
        self.close_film.setVisible(is_film or is_live)
        self.close_film.setText("Stop camera" if is_live else "Close")
        self.close_film.setToolTip(
            "Release the camera; the last picture stays."
            if is_live
            else "Close the film, and show the simulated one."
        )
        self.axis.setVisible(is_film or is_live)
        self.lock.setVisible(is_live)
        self.read.setVisible(not is_live)

    def show_state(self, *, is_reading: bool, is_read: bool) -> None:
        """Let the button offer what comes next: to read the film, to stop, or to read it again."""
        start = "Read again" if is_read else "Read the film"
        self.read.setText("Stop reading" if is_reading else start)
        self.read.setToolTip(
            "Stop; what has been read so far stays."
            if is_reading
            else "Find the packets in all frames, and measure the camera's clock."
        )

    def list_cameras(self, devices: Sequence[CameraDevice] | None) -> None:
        self.cameras.clear()
        for device in devices or ():
            action = self.cameras.addAction(in_menu(device.name))
            action.triggered.connect(lambda _=False, device=device: self.camera_chosen.emit(device))
        if not devices:
            words = "No camera was found" if devices is not None else "Looking…"
            self.cameras.addAction(words).setEnabled(False)


class Transport(QWidget):
    """Buttons to play and step, and the number and time of the frame that is shown."""

    play_asked = Signal()  # the user starts or stops the film
    step_asked = Signal(int)  # the number of frames to step forward; negative for back

    def __init__(self) -> None:
        super().__init__()
        self.back, self.play, self.forward = (
            IconButton(drawing, _ICON) for drawing in ("step-back", "play", "step-on")
        )
        name_widget(self.back, "Previous frame", "Show the frame before (Left).")
        name_widget(self.forward, "Next frame", "Show the frame after (Right).")
        self.place = name_widget(ElidedLabel(), "Frame and time shown")
        self.place.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        parts = (self.back, self.play, self.forward, 6, (self.place, 1))
        fill(QHBoxLayout(self), *parts, margins=0, spacing=2)
        self.back.clicked.connect(lambda: self.step_asked.emit(-1))
        self.forward.clicked.connect(lambda: self.step_asked.emit(1))
        self.play.clicked.connect(self.play_asked)
        self.show_playing(False)

    def show_playing(self, playing: bool) -> None:
        self.play.show_drawing("pause" if playing else "play")
        if playing:
            name_widget(self.play, "Pause", "Stop at this frame (Space).")
        else:
            name_widget(self.play, "Play", "Play the film at its own speed (Space).")

    def show_place(self, index: int, count: int | None, time: float | None) -> None:
        """Show the index of the frame, the number of frames, and the time in seconds."""
        if time is None:
            self.place.set_full_text("")
            return
        of_all = f" of {count}" if count else ""
        self.place.set_full_text(f"frame {index + 1}{of_all}, {time:.4f} s")

    def set_usable(self, usable: bool) -> None:
        for button in (self.back, self.play, self.forward):
            button.setEnabled(usable)


class DataView(QWidget):
    """What was read from a film: a sentence, the text, remarks, and a table of facts."""

    def __init__(self) -> None:
        super().__init__()
        hint = "What is read from the film appears here."
        field = QPlainTextEdit(readOnly=True, placeholderText=hint, tabChangesFocus=True)
        self.text = name_widget(field, "What was read")
        self.text.setMinimumHeight(_LEAST_TEXT_HEIGHT)
        self.sentences = paragraph(name="What is not sure")
        self.sentences.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.rows: list[tuple[QLabel, QLabel]] = []
        table = QWidget()
        self._grid = QGridLayout(table)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(12)
        self._grid.setVerticalSpacing(2)
        self._grid.setRowStretch(100, 1)
        self.answer = Answer(table)
        parts = (self.answer, (self.text, 1), self.sentences)
        left = fill(QVBoxLayout(), *parts, margins=0, spacing=4)
        fill(QHBoxLayout(self), (left, 1), table, margins=(6, 6, 6, 4), spacing=12)
        self.show_reading(FilmReading())

    def show_reading(self, reading: FilmReading) -> None:
        self.answer.show_answer(reading.answer)
        self.answer.setVisible(bool(reading.answer))
        self._show_text(reading.text[-_MOST_TEXT:])
        self._show_facts(reading.facts)
        self.sentences.setText("\n".join(reading.sentences))
        self.sentences.setVisible(bool(reading.sentences))

    def _show_text(self, text: str) -> None:
        old_text = self.text.toPlainText()
        if text == old_text:
            return
        bar = self.text.verticalScrollBar()
        is_at_end, place = bar.value() >= bar.maximum(), bar.value()
        if old_text and text.startswith(old_text):  # a selection stays
            cursor = QTextCursor(self.text.document())
            cursor.movePosition(QTextCursor.MoveOperation.End)
            cursor.insertText(text[len(old_text) :])
        else:
            self.text.setPlainText(text)
        bar.setValue(bar.maximum() if is_at_end else place)

    def _show_facts(self, facts: tuple[Fact, ...]) -> None:
        while len(self.rows) < len(facts):
            self._add_row()
        for fact, (name, value) in zip(facts, self.rows, strict=False):
            name.setText(fact.label)
            value.setText(fact.text)
            value.setAccessibleName(fact.label)
            meaning = f"{fact.meaning} ({fact.note})" if fact.note else fact.meaning
            for part in (name, value):
                part.setToolTip(in_tool_tip(meaning))
        for place, row in enumerate(self.rows):
            for part in row:
                part.setVisible(place < len(facts))

    def _add_row(self) -> None:
        name, value = QLabel(), QLabel()
        value.setTextFormat(Qt.TextFormat.PlainText)
        value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        for column, part in enumerate((name, value)):
            self._grid.addWidget(part, len(self.rows), column)
        self.rows.append((name, value))


class VideoView(QWidget):
    """Pictures at the top, pages of rows, data and recording below them, and the timeline."""

    def __init__(self) -> None:
        super().__init__()
        self.bar, self.pictures = FilmBar(), FilmPictures()
        self.rows, self.data, self.form = FrameRows(), DataView(), RecordingForm()
        self.transport, self.timeline, self.legend = Transport(), Timeline(), MarkLegend()
        self.message = paragraph(name="What is wrong with the film")
        self.message.hide()
        self.pages = QTabWidget(documentMode=True)
        self.pages.addTab(self.data, "What is read")
        # They scroll in a low pane, so that every page leaves the pictures the same height.
        for page, title in ((self.rows, "This frame"), (self.form, "Recording")):
            self.pages.addTab(ScrollPane(page, _LEAST_PAGE), title)
        self.split = QSplitter(Qt.Orientation.Vertical, childrenCollapsible=False)
        self.split.addWidget(self.pictures)
        self.split.addWidget(self.pages)
        # In this proportion, the bits of a frame fit in a low window.
        self.split.setSizes([150, 350])
        line = fill(QHBoxLayout(), (self.transport, 1), self.legend, margins=0)
        fill(
            QVBoxLayout(self), self.bar, self.message, (self.split, 1), line, self.timeline,
            margins=(6, 4, 6, 4), spacing=4,
        )  # fmt: skip
        self.rows.picture_asked.connect(self.show_large)
        self._outdated = [OutdatedMark(part) for part in (self.data, self.timeline)]

    def show_message(self, sentence: str) -> None:
        """Show an error of the film or the camera; empty for none."""
        self.message.setText(sentence)
        self.message.setVisible(bool(sentence))

    def show_large(self) -> None:
        """Give the pictures most of the pane, and show them whole."""
        height = sum(self.split.sizes())
        large = _LARGE_PICTURE_PERCENT * height // 100
        self.split.setSizes([large, height - large])
        self.pictures.fit()

    def show_reading(self, reading: FilmReading, frames: Marks) -> None:
        self.data.show_reading(reading)
        self.timeline.show_frames(frames)
        self.timeline.show_packets(reading.packets)

    def show_outdated(self, outdated: bool) -> None:
        for mark in self._outdated:
            mark.show_age(1.0 if outdated else 0.0, "read for an earlier scene")

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Pass keys that no other widget uses to the timeline."""
        self.timeline.keyPressEvent(event)

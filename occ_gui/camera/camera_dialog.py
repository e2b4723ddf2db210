"""The dialog *Measure my camera*: two pictures, the mains, the answer, and the bars over them."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QVBoxLayout,
    QWidget,
)

from occ_gui.camera.bars_picture import BarsPicture
from occ_gui.camera.jobs import CameraAnswer
from occ_gui.widgets.answer import Answer
from occ_gui.widgets.building import (
    ElidedLabel,
    KeyedComboBox,
    ScrollPane,
    embolden,
    fill,
    paragraph,
)
from occ_gui.widgets.work_bar import WorkBar

_HOW = "Take two pictures of a lit wall at 1/1000 s."
_WHY = (
    "One after the other, of any room or wall under lamps on the mains, without daylight or "
    "flash; or one at 1/1000 s and one at 1/25 s. Their bars tell how fast the camera reads its "
    "lines. Use whole pictures: not cropped, and without lens correction."
)
_MAINS = {"50": "50 Hz", "60": "60 Hz (the Americas, parts of Asia)"}
_LEAST_ANSWER_SIZE = QSize(320, 90)
_DROP = "Choose two pictures, or drop them here."


class CameraDialog(QDialog):
    pictures_asked = Signal()  # the user wants to choose files
    pictures_dropped = Signal(list)
    mains_chosen = Signal(str)
    cancel_asked = Signal()
    readout_chosen = Signal()  # the scene shall have the readout time

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Measure my camera")
        self.setAcceptDrops(True)
        self.mains = KeyedComboBox("Mains", "The frequency of the mains where you are.", _MAINS)
        self.mains.chosen.connect(self.mains_chosen)
        self.pictures = [BarsPicture(name) for name in ("First picture", "Second picture")]
        self.names = [ElidedLabel() for _ in self.pictures]
        self.answer = Answer()
        self.work = WorkBar("the measurement")
        self.work.cancelled.connect(self.cancel_asked)
        row = QHBoxLayout()
        for picture, name in zip(self.pictures, self.names, strict=True):
            row.addLayout(fill(QVBoxLayout(), (picture, 1), name, margins=0, spacing=4), 1)
        form = QFormLayout()
        form.addRow("&Mains", self.mains)
        fill(
            QVBoxLayout(self),
            embolden(QLabel(_HOW)),
            paragraph(_WHY),
            form,
            (row, 2),
            self.work,
            (ScrollPane(self.answer, _LEAST_ANSWER_SIZE), 1),
            self._make_buttons(),
        )
        self.resize(700, 600)
        self.show_pictures(())

    def _make_buttons(self) -> QDialogButtonBox:
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        roles = QDialogButtonBox.ButtonRole
        self.choose = buttons.addButton("&Choose pictures…", roles.ActionRole)
        self.choose.setToolTip(
            "Choose two pictures of one room. One of an even wall is measured, but always doubtful."
        )
        self.use = buttons.addButton("&Use this readout time", roles.ActionRole)
        self.use.setToolTip("Set the scene's readout time to what was measured.")
        self.use.setEnabled(False)
        buttons.button(QDialogButtonBox.StandardButton.Close).setToolTip("Close this dialog.")
        self.choose.clicked.connect(self.pictures_asked)
        self.use.clicked.connect(self.readout_chosen)
        buttons.rejected.connect(self.reject)
        return buttons

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:  # noqa: N802 - Qt's name
        if event.mimeData().hasUrls():
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:  # noqa: N802 - Qt's name
        urls = event.mimeData().urls()
        self.pictures_dropped.emit([Path(url.toLocalFile()) for url in urls if url.isLocalFile()])
        event.acceptProposedAction()

    def show_pictures(self, names: Sequence[str]) -> None:
        """Show the names of the chosen files, before they are read."""
        for place, (picture, name) in enumerate(zip(self.pictures, self.names, strict=True)):
            picture.show_picture(None)
            name.set_full_text(names[place] if place < len(names) else "")
        self.use.setEnabled(False)
        self.answer.show_answer("" if names else _DROP)

    def show_answer(self, answer: CameraAnswer) -> None:
        for view, small in zip(self.pictures, answer.pictures, strict=False):
            view.show_picture(small)
        measured = answer.measured
        self.use.setEnabled(measured is not None)
        if measured is None:
            self.answer.show_answer(answer.refusal)
            return
        is_along_columns = measured.scan_axis == "columns"
        self.pictures[0].show_bars(measured.waves, is_along_columns=is_along_columns)
        facts = (f"{fact.label}: {fact}" for fact in measured.facts)
        self.answer.show_answer(measured.sentence, [*measured.reasons, *facts, measured.assumption])

    def show_failure(self, sentence: str) -> None:
        self.use.setEnabled(False)
        self.answer.show_answer(sentence)

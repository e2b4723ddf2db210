"""The window: panes in docks, and the menus."""

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QAction, QActionGroup, QCloseEvent, QKeySequence, QUndoStack
from PySide6.QtWidgets import QDockWidget, QLabel, QMainWindow, QMenu, QWidget

from occ_gui.views.accuracy_view import AccuracyView
from occ_gui.views.decode_view import DecodeView
from occ_gui.views.image_view import ImageView
from occ_gui.views.profile_view import ProfileView
from occ_gui.widgets.control_panel import ControlPanel
from occ_gui.widgets.elided_label import ElidedLabel
from occ_model.photo.load import SCAN_AXES

_FIRST_SIZE = QSize(1280, 800)


class MainWindow(QMainWindow):
    """Docks and menus; what they do is connected in :mod:`occ_gui.application`.

    Parameters
    ----------
    controls, image, profile, decode, accuracy
        The panes.
    undo_stack
        The steps that the edit menu undoes.
    """

    closing = Signal()
    """The window is about to close."""

    def __init__(
        self,
        controls: ControlPanel,
        image: ImageView,
        profile: ProfileView,
        decode: DecodeView,
        accuracy: AccuracyView,
        undo_stack: QUndoStack,
    ) -> None:
        super().__init__()
        self.setWindowTitle(self.tr("Optical Camera Communication"))
        self.setDockNestingEnabled(True)
        self.setCentralWidget(image)
        left, right = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea
        bottom = Qt.DockWidgetArea.BottomDockWidgetArea
        self.setCorner(Qt.Corner.BottomLeftCorner, left)
        self.docks = {
            "controls": self._dock("controls", self.tr("Scene"), controls, left),
            "decode": self._dock("decode", self.tr("Decoding"), decode, right),
            "profile": self._dock("profile", self.tr("Column profile"), profile, bottom),
            "accuracy": self._dock("accuracy", self.tr("Accuracy and time"), accuracy, bottom),
        }
        self.tabifyDockWidget(self.docks["profile"], self.docks["accuracy"])
        self.docks["profile"].raise_()
        self.docks["accuracy"].visibilityChanged.connect(accuracy.set_seen)
        self.resizeDocks([self.docks["profile"]], [308], Qt.Orientation.Vertical)
        self.resizeDocks(
            [self.docks["controls"], self.docks["decode"]], [340, 360], Qt.Orientation.Horizontal
        )
        self.actions_by_name: dict[str, QAction] = {}
        self._make_file_menu()
        self._make_edit_menu(undo_stack)
        self._make_view_menu(image)
        self._make_help_menu()
        self._said_until = ""
        self._plan_change = ElidedLabel("", Qt.TextElideMode.ElideRight)
        self._timing = QLabel()
        self.statusBar().addWidget(self._plan_change, 1)  # seen while there is no message
        self.statusBar().addPermanentWidget(self._timing)
        self.resize(_FIRST_SIZE)

    def _dock(
        self, name: str, title: str, content: QWidget, area: Qt.DockWidgetArea
    ) -> QDockWidget:
        dock = QDockWidget(title, self)
        dock.setObjectName(name)
        dock.setWidget(content)
        self.addDockWidget(area, dock)
        return dock

    def _add(
        self, menu: QMenu, name: str, text: str, shortcut: QKeySequence.StandardKey | None = None
    ) -> QAction:
        action = menu.addAction(text)
        if shortcut is not None:
            action.setShortcut(QKeySequence(shortcut))
        self.actions_by_name[name] = action
        return action

    def _make_file_menu(self) -> None:
        keys = QKeySequence.StandardKey
        menu = self.menuBar().addMenu(self.tr("&File"))
        self._add(menu, "open_photo", self.tr("Open &photo…"), keys.Open)
        self._add(menu, "close_photo", self.tr("&Close photo")).setEnabled(False)
        menu.addSeparator()
        self._add(menu, "open_scene", self.tr("Open sc&ene…"))
        self._add(menu, "save_scene", self.tr("&Save scene as…"), keys.Save)
        self._add(menu, "save_picture", self.tr("Save simulated p&icture as…"))
        menu.addSeparator()
        self._add(menu, "quit", self.tr("&Quit"), keys.Quit).triggered.connect(self.close)

    def _make_edit_menu(self, undo_stack: QUndoStack) -> None:
        menu = self.menuBar().addMenu(self.tr("&Edit"))
        undo = undo_stack.createUndoAction(self, self.tr("&Undo"))
        redo = undo_stack.createRedoAction(self, self.tr("&Redo"))
        undo.setShortcut(QKeySequence(QKeySequence.StandardKey.Undo))
        redo.setShortcut(QKeySequence(QKeySequence.StandardKey.Redo))
        menu.addActions([undo, redo])

    def _make_view_menu(self, image: ImageView) -> None:
        menu = self.menuBar().addMenu(self.tr("&View"))
        self._add(menu, "fit", self.tr("&Fit pictures")).triggered.connect(image.fit)
        self.actions_by_name["fit"].setShortcut(QKeySequence(self.tr("Ctrl+0")))
        over = self._add(menu, "photo_over", self.tr("Photo &over the simulation"))
        over.setCheckable(True)
        over.toggled.connect(image.set_over)
        axes = menu.addMenu(self.tr("Photo was &scanned"))
        self.scan_axes = QActionGroup(self)
        texts = {
            "auto": self.tr("&Automatic: across its stripes"),
            "columns": self.tr("Column by &column"),
            "lines": self.tr("&Line by line"),
        }
        for axis in SCAN_AXES:
            action = self._add(axes, f"scan_{axis}", texts[axis])
            action.setCheckable(True)
            action.setChecked(axis == SCAN_AXES[0])
            action.setData(axis)
            self.scan_axes.addAction(action)
        menu.addSeparator()
        for dock in self.docks.values():
            menu.addAction(dock.toggleViewAction())

    def _make_help_menu(self) -> None:
        menu = self.menuBar().addMenu(self.tr("&Help"))
        self._add(menu, "about", self.tr("&About"))

    def show_photo_name(self, name: str | None) -> None:
        """Tell which photo is open, if any."""
        self.actions_by_name["close_photo"].setEnabled(name is not None)
        title = self.tr("Optical Camera Communication")
        self.setWindowTitle(f"{name} – {title}" if name else title)  # noqa: RUF001 - a dash

    def show_timing(self, simulation: float, reading: float) -> None:
        """Tell how many seconds the last simulation took, and the reading of its picture."""
        self._timing.setText(
            self.tr("simulated in {simulation:.1f} ms, read in {reading:.1f} ms").format(
                simulation=1e3 * simulation, reading=1e3 * reading
            )
        )

    def show_plan_change(self, sentence: str) -> None:
        """Tell which effects the plan has just switched, while there is nothing else to say."""
        self._plan_change.set_full_text(sentence)

    def say(self, sentence: str, until: str = "") -> None:
        """Show a sentence in the status line, until the next one or until ``until`` has happened.

        Parameters
        ----------
        sentence
            The sentence.
        until
            What :meth:`happened` will be told of.
        """
        self._said_until = until
        self.statusBar().showMessage(sentence)

    def happened(self, what: str) -> None:
        """Clear the sentence that was to be shown until this happened."""
        if self._said_until == what:
            self.statusBar().clearMessage()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 - Qt's name
        """Tell before closing."""
        self.closing.emit()
        super().closeEvent(event)

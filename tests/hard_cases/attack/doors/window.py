"""The whole window: what it has kept, the files that are dropped on it, what is typed in it."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import damaged_photos

from hard_cases.attack import hostile
from hard_cases.attack.doors.scenes import exported, lesson_texts, preset_texts, scene_texts
from hard_cases.attack.doors.state import SESSION, SETTINGS, damaged_ini, session_text
from hard_cases.attack.promise import LONGEST, Door
from occ_model.scene.presets import USER_FOLDER as PRESETS
from occ_model.teaching.lessons import USER_FOLDER as LESSONS

if TYPE_CHECKING:  # Qt is slow to import, and other doors do not need it
    from PySide6.QtWidgets import QApplication

    from occ_gui.app.application import Application

_PATIENCE_MS = 3_000  # milliseconds that a window is given to come to rest


@dataclass
class _Opened:
    """A window, with what its status line has shown and which of its slots have raised."""

    application: "Application"
    said: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


@cache
def _qt() -> "QApplication":
    """The one application of Qt that this process may have."""
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    from PySide6.QtWidgets import QApplication

    from occ_gui.app.error_reports import log_qt_messages

    qt = QApplication.instance() or QApplication(["attack"])
    log_qt_messages()
    return qt  # type: ignore[return-value]


@contextmanager
def _window(folder: Path) -> Iterator[_Opened]:
    """Open a window that keeps its state in a folder, as the command line does; then close it."""
    import pytest
    from PySide6.QtCore import QEvent
    from PySide6.QtWidgets import QApplication

    from occ_gui.app.application import Application
    from occ_gui.app.command_line import make_parser
    from occ_gui.app.start import start_of
    from occ_gui.detection_map import wiring
    from occ_model.commands.options import scene_of, simulation_settings_of

    _qt()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("OCC_STATE", str(folder))
        patch.setenv(PRESETS, str(folder / "presets"))
        patch.setenv(LESSONS, str(folder / "lessons"))
        patch.setattr(wiring, "new_workers", _no_workers)
        options = make_parser().parse_args(["--set", "rows=20"])
        settings = simulation_settings_of(options)
        begin = start_of(options, scene_of(options), settings, has_settings=True)
        application = Application(begin.first_workspace, begin.preferences)
        opened = _Opened(application)
        application.window.statusBar().messageChanged.connect(opened.said.append)
        application.error_reports.reported.connect(opened.faults.append)
        try:
            begin.restore(application, with_photo=True)
            application.window.show()
            _rest(application)
            yield opened
            _rest(application)
        finally:
            application.window.close()
            application.stop()
            application.window.deleteLater()
            QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
            QApplication.processEvents()


def _no_workers() -> object:
    from gui.conftest import LazyWorkers

    return LazyWorkers()


def _rest(application: "Application") -> None:
    """Process events until all that was asked for is shown, or for a while."""
    from PySide6.QtCore import QDeadlineTimer, QEventLoop
    from PySide6.QtWidgets import QApplication

    deadline = QDeadlineTimer(_PATIENCE_MS)
    while True:
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, 20)
        if application.is_idle or deadline.hasExpired():
            return


@cache
def _kept() -> dict[str, str]:
    """What a window keeps that was opened and closed."""
    with TemporaryDirectory() as folder:
        with _window(Path(folder)):
            pass
        return {name: Path(folder, name).read_text("utf-8") for name in (SESSION, SETTINGS)}


def _leave_state(chance: Random, folder: Path) -> None:
    """Write what the window reads at its start, damaged."""
    session = session_text() if chance.random() < 0.5 else _kept()[SESSION]
    (folder / SESSION).write_bytes(hostile.encoded(chance, hostile.damaged(chance, session)))
    ini = damaged_ini(chance, _kept()[SETTINGS])
    (folder / SETTINGS).write_bytes(hostile.encoded(chance, ini))
    for kind, texts in (("presets", preset_texts()), ("lessons", lesson_texts())):
        (folder / kind).mkdir()
        text = hostile.damaged(chance, chance.choice(texts))
        (folder / kind / "own.toml").write_bytes(hostile.encoded(chance, text))


def _drop(chance: Random, folder: Path, application: "Application") -> None:
    """Drop a few damaged files of any kind."""
    paths = []
    for number in range(chance.choice((1, 1, 2))):
        kind = chance.choice(("toml", "photo", "photo", "odd", "svg", "csv", "png"))
        if kind == "toml":
            content = hostile.encoded(chance, hostile.damaged(chance, chance.choice(scene_texts())))
        elif kind in ("photo", "odd"):
            make = damaged_photos.damaged if kind == "photo" else damaged_photos.odd
            content = make(chance.getrandbits(32))[1]
        else:
            text = hostile.damaged(chance, exported()[kind].decode("latin-1"))
            content = text.encode("latin-1", "replace")
        path = folder / f"{chance.choice(('a', chr(27) + '[31m', 'é' * 60))}{number}.{kind}"
        path.write_bytes(content)
        paths.append(path)
    application.files.open_dropped(paths)


def _type(chance: Random, application: "Application") -> None:
    """Type anything in some fields, and leave each."""
    from PySide6.QtWidgets import QLineEdit

    fields = [each for each in application.window.findChildren(QLineEdit) if each.isEnabled()]
    for each in chance.sample(fields, min(6, len(fields))):
        text = hostile.quantity(chance) if chance.random() < 0.7 else hostile.word(chance)
        each.setText(text.encode("utf-8", "replace").decode())
        each.textEdited.emit(each.text())
        each.returnPressed.emit()
        each.editingFinished.emit()


def _used(chance: Random, folder: Path) -> list[str]:
    from occ_gui.values.modes import MODES

    _leave_state(chance, folder)
    with _window(folder) as opened:
        application = opened.application
        application.window.modes.switch(chance.choice((*MODES,)))
        for _ in range(chance.choice((1, 2, 3))):
            if chance.random() < 0.5:
                _drop(chance, folder, application)
            else:
                _type(chance, application)
            _rest(application)
    assert opened.faults == []
    for text in opened.said:
        assert text.isprintable(), f"not one printable line: {text!r}"
        assert len(text) <= LONGEST, f"{len(text)} characters"
    return []


WINDOW = Door(
    "window", "a whole window: what it kept, what is dropped and typed", _used, (), fraction=4,
    patience=40.0,
)  # fmt: skip

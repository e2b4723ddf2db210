"""Why a file was not opened is said in the middle of the window, until it no longer matters."""

from pathlib import Path

from gui.user import User
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application


def drop(application: Application, user: User, path: Path) -> None:
    application.window.dropped.emit([path])
    user.wait_until_idle()
    QApplication.processEvents()


def test_files_that_cannot_be_opened_say_so_in_the_middle_and_not_at_the_bottom_too(
    application: Application, user: User, tmp_path: Path, qtbot: QtBot
) -> None:
    window, banner = application.window, application.window.failure
    (message,) = (
        label
        for label in window.statusBar().findChildren(QLabel)
        if label.accessibleName() == "Message"
    )
    bad_scene, no_photo, no_film = (tmp_path / name for name in ("a.toml", "b.txt", "c.mp4"))
    bad_scene.write_text("format = 1\n[camera]\niso = 'x'\n", encoding="utf-8")
    no_photo.write_text("hello", encoding="utf-8")
    no_film.write_bytes(b"\0\0\0\x18ftypmp42" + bytes(99))
    for path, part in (
        (bad_scene, "iso"), (no_photo, "b.txt"), (no_film, "c.mp4"), (tmp_path, "is not a file")
    ):  # fmt: skip
        drop(application, user, path)
        for _ in range(9):
            QApplication.processEvents()
        assert part in banner.sentence.text()
        assert banner.isVisible()
        assert window.rect().contains(banner.geometry())
        assert user.message == banner.sentence.text()
        assert message.text() == ""
    banner.close_button.click()
    assert not banner.isVisible()
    drop(application, user, bad_scene)
    qtbot.keyClick(window, Qt.Key.Key_Escape)
    assert not banner.isVisible()
    drop(application, user, bad_scene)
    assert banner.isVisible()
    application.scene_store.change(iso=250.0)  # the user goes on
    assert not banner.isVisible()

"""The welcome page offers four ways to begin, at the first start and from the menu."""

from pathlib import Path
from typing import Any, cast

import pytest
from gui.pane_bench import PaneBench
from pytestqt.qtbot import QtBot

from occ_gui.app.services import welcome
from occ_gui.app.start import Start
from occ_gui.core.workspace import Workspace
from occ_gui.files.preferences import Preferences
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import SavedSession
from occ_gui.welcome.welcome import Welcome
from occ_model.scene.scene import Scene


def test_the_page_appears_by_itself_only_once(qtbot: QtBot, small_scene: Scene) -> None:
    bench, files = (
        PaneBench(qtbot, small_scene),
        cast("Any", None),
    )  # not used by the choices that are tried
    page: Welcome = bench.add(
        welcome(cast("Any", bench.window), bench.shell, Preferences(None), files)
    )
    page.show_once()
    for button in page.dialog.buttons.values():
        assert button.accessibleName()
        assert button.accessibleDescription().endswith(".")
    page.dialog.close()
    assert page.dialog is None
    page.show_once()
    assert page.dialog is None


@pytest.mark.parametrize("asked", [False, True])
def test_a_start_that_names_a_scene_is_no_first_one(asked: bool, tmp_path: Path) -> None:
    file, workspace = SessionFile(tmp_path), Workspace(Scene())
    assert Start(workspace, asked, session_file=file).is_new != asked
    file.write(SavedSession(workspace), in_use=False)
    file.close()
    again = SessionFile(tmp_path)
    assert not Start(workspace, asked, session_file=again).is_new
    again.close()

"""Pages of text look like their stored pictures; see test_panes for renewing them."""

from collections.abc import Callable
from pathlib import Path

from gui.kinds import SnapshotOf, show_widget
from gui.snapshots.drawing import show
from PIL import Image
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from occ_gui.explanation.pane import ExplanationView
from occ_gui.help.help_window import HelpWindow
from occ_gui.photo.photo_view import PhotoView
from occ_gui.welcome.welcome import WelcomeDialog
from occ_model.photo.reading.load import Photo
from occ_model.scene.scene import Scene
from occ_model.teaching.equations import equations
from occ_model.teaching.light_over_columns import exposure_window

Matches = Callable[[QWidget, str], None]

PAGE = """\
# A page

A paragraph of some words,
with a [link](index.md).

```
code = of
two + lines
```

## A heading below

| one | two |
|---|---|
| 1 | 2.5 |

The last words.

![a picture](picture.png)
"""


def test_the_three_doors_look_as_stored(qtbot: QtBot, matches_its_picture: Matches) -> None:
    dialog = show_widget(qtbot, WelcomeDialog())
    matches_its_picture(dialog, "welcome")


def test_a_page_of_the_manual_looks_as_stored(
    qtbot: QtBot, matches_its_picture: Matches, tmp_path: Path
) -> None:
    (tmp_path / "index.md").write_text("* [A page](page.md): about it\n", encoding="utf-8")
    (tmp_path / "page.md").write_text(PAGE, encoding="utf-8")
    Image.new("RGB", (900, 60), (60, 120, 180)).save(tmp_path / "picture.png")
    manual = HelpWindow(tmp_path)
    show(qtbot, manual, 520, 470)
    manual.show_page("page.md")
    matches_its_picture(manual, "manual")


def test_the_explanation_looks_as_stored(
    qtbot: QtBot, matches_its_picture: Matches, snapshot_of: SnapshotOf
) -> None:
    view = ExplanationView()
    show(qtbot, view, 400, 360)
    scene = snapshot_of().frame.scene
    view.equations.show_equations(equations(scene), frozenset())
    view.exposure.show_column(100, scene.camera.columns, True)
    view.exposure.show_window(exposure_window(scene, 100), 42.25)
    matches_its_picture(view, "explanation")


def test_the_pane_of_a_photo_looks_as_stored(
    qtbot: QtBot, matches_its_picture: Matches, photo: Photo
) -> None:
    view = PhotoView()
    show(qtbot, view, 400, 420)
    view.show_scene(Scene())
    view.show_photo(photo)
    matches_its_picture(view, "photo")

"""The pane of the whole picture: each of its parts is drawn where it differs."""

from dataclasses import replace
from typing import TypeAlias

from occ_gui.core.store import Store
from occ_gui.picture.image_view import ImageView
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import of_picture
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_gui.values.photo_choice import MODES
from occ_model.results.frame import PICTURES

PicturePart: TypeAlias = tuple[
    Picture | None, Snapshot | None, Reading | None, Snapshot | None, str, str
]
"""The picture, the exact results, the reading, the results before, whose picture is shown, and
how a photo is shown with it."""


class PicturesPane(Pane[PicturePart]):
    def __init__(self, store: Store) -> None:
        self.view = view = ImageView()
        super().__init__(view)
        self.made_of = {view.simulation: of_picture}
        self._shown: PicturePart = (None, None, None, None, PICTURES[0], MODES[0])
        view.picture_chosen.connect(lambda whose: store.put(replace(store.workspace, whose=whose)))
        view.mode_chosen.connect(lambda mode: store.put(replace(store.workspace, overlay=mode)))

    def show_part(self, part: PicturePart) -> None:
        view, shown, self._shown = self.view, self._shown, part
        picture, snapshot, reading, before, whose, overlay = part
        view.choose_picture(whose)
        if overlay != shown[5]:
            view.set_mode(overlay)
        if before is not None and before is not shown[3]:
            view.before.show_before(before)
        if picture is not None and picture is not shown[0]:
            view.show_picture(picture)
        if snapshot is not None and snapshot is not shown[1]:
            view.show_snapshot(snapshot)
        if reading is not None and reading is not shown[2]:
            view.show_reading(reading)

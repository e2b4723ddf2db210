"""The pane of the column profile: each of its parts is drawn where it differs."""

from dataclasses import replace
from typing import TypeAlias

from occ_gui.core.store import Store
from occ_gui.profile.profile_view import ProfileView
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import of_reading
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_gui.values.photo_results import PhotoProfile
from occ_model.results.match import ChipReading

ProfilePart: TypeAlias = tuple[
    Reading | None, Snapshot | None, PhotoProfile | None, ChipReading | None, bool
]
"""The reading, the results before, the photo's profile and chips, and whether all is enhanced."""


class ProfilePane(Pane[ProfilePart]):
    """The profile of the scene, with those of before and of a photo."""

    def __init__(self, store: Store) -> None:
        self.view = view = ProfileView()
        super().__init__(view)
        self.made_of = {view: of_reading}
        self._shown: ProfilePart = (None, None, None, None, False)
        view.chips.copied.connect(self.status_message)
        view.enhanced_chosen.connect(lambda on: store.put(replace(store.workspace, is_enhanced=on)))

    def show_part(self, part: ProfilePart) -> None:
        view, shown, self._shown = self.view, self._shown, part
        reading, before, photo, chips, is_enhanced = part
        view.enhanced.setChecked(is_enhanced)
        if before is not None and before is not shown[1]:
            view.show_before(before)
        if reading is not None and reading is not shown[0]:
            view.show_reading(reading)
        if photo is not shown[2]:
            view.show_photo_profile(photo)
        if chips is not shown[3]:
            view.chips.show_chips(chips)

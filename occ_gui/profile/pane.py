"""The pane of the column profile; only the parts that have changed are drawn again."""

from dataclasses import replace

from occ_gui.core.store import Store
from occ_gui.profile.profile_view import ProfileView
from occ_gui.shell.feature import PiecesPane
from occ_gui.shell.results import of_reading


class ProfilePane(PiecesPane):
    def __init__(self, store: Store) -> None:
        self.view = view = ProfileView()
        super().__init__(
            view, view.enhanced.setChecked, view.show_before, view.show_reading,
            view.show_photo_profile, view.chips.show_chips,
        )  # fmt: skip
        self.made_of = {view: of_reading}
        view.chips.copied.connect(self.status_message)
        view.enhanced_chosen.connect(lambda on: store.put(replace(store.workspace, is_enhanced=on)))

"""Options of the view: theme, text size, layout and held brightness, stored for the next start."""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject

from occ_gui.core.store import Store
from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_editor import BrightnessHold
from occ_gui.window.docks import DockLayout
from occ_gui.window.main_window import MainWindow
from occ_gui.window.text_size import TextSize
from occ_gui.window.theme import ThemeController

_THEME, _TEXT = "view/theme", "view/text_percent"
_HOLD, _YES = "edit/hold_brightness", "yes"


class ViewOptions(QObject):
    def __init__(
        self,
        window: MainWindow,
        store: Store,
        preferences: Preferences,
        hold: BrightnessHold,
        say: Callable[[str], None],
    ) -> None:
        super().__init__(window)
        self._window, self._store, self._preferences, self._say = window, store, preferences, say
        self.theme, self.text_size, self.brightness = ThemeController(), TextSize(), hold
        window.apply_style()
        self.layout = DockLayout(window, window.modes, preferences)
        self.theme.chosen.connect(self._on_theme)
        self.theme.coloured.connect(window.apply_style)
        self.text_size.chosen.connect(self._on_text_size)
        hold.switched.connect(self._on_hold)
        window.actions_by_name["hold_brightness"].triggered.connect(hold.switch)
        menus = window.menus
        menus.themes.triggered.connect(lambda action: self.theme.choose(action.data()))
        menus.overlays.triggered.connect(lambda action: self.choose_overlay(action.data()))
        store.select(lambda workspace: workspace.overlay).changed.connect(self._show_overlay)

    def restore(self) -> None:
        """Restore the options of the last window, before this one is shown."""
        recall = self._preferences.recall
        self.layout.restore()
        self.theme.choose(recall(_THEME))
        if (percent := recall(_TEXT)).isdecimal():
            self.text_size.choose(int(percent))
        self.brightness.switch(recall(_HOLD) == _YES)

    def choose_overlay(self, mode: str) -> None:
        self._store.put(replace(self._store.workspace, overlay=mode))

    def _show_overlay(self, mode: str) -> None:
        menus = self._window.menus
        menus.show_choice(menus.overlays, mode)

    def _on_theme(self, theme: str) -> None:
        self._preferences.keep(_THEME, theme)
        menus = self._window.menus
        menus.show_choice(menus.themes, theme)

    def _on_text_size(self, percent: int) -> None:
        self._preferences.keep(_TEXT, str(percent))
        self._say(f"Text at {percent} %")

    def _on_hold(self, on: bool) -> None:
        self._preferences.keep(_HOLD, _YES if on else "")
        self._window.actions_by_name["hold_brightness"].setChecked(on)

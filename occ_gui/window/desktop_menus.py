"""The menu entries of a desktop program: export, layout, theme, palette, shortcuts."""

from collections.abc import Mapping

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu

from occ_gui.window.menus import Menus

THEMES = ("system", "light", "dark")
"""Whose colours the window takes."""


class DesktopMenus(QObject):
    """Adds its entries to the window's menus.

    Parameters
    ----------
    menus
        The window's menus.
    figures
        Titles of the figures that can be exported, by their names.
    """

    def __init__(self, menus: Menus, figures: Mapping[str, str]) -> None:
        super().__init__(menus)
        self._menus = menus
        self.figures: dict[str, QAction] = {}
        self._make_export(figures)
        self._make_edit()
        self._make_view()
        self._make_help()

    def _add(self, menu: QMenu, name: str, text: str, shortcut: str = "") -> QAction:
        action = QAction(text, menu)
        if shortcut:
            action.setShortcut(QKeySequence(shortcut))
        menu.addAction(action)
        self._menus.actions[name] = action
        return action

    def _make_export(self, figures: Mapping[str, str]) -> None:
        self._export = QMenu(self.tr("E&xport"), self._menus.tops["file"])
        self._export.setToolTipsVisible(True)
        self._menus.tops["file"].insertMenu(self._menus.actions["delete_preset"], self._export)
        self._menus.tops["file"].insertSeparator(self._menus.actions["delete_preset"])
        self._last = self._export.addSeparator()
        for name, title in figures.items():
            self.add_figure(name, title)
        self._add(self._export, "export_all", self.tr("A&ll figures…"), self.tr("Ctrl+Shift+E"))

    def add_figure(self, name: str, title: str) -> QAction:
        """Offer one more figure to be exported."""
        action = QAction(self.tr("{figure}…").format(figure=title), self._export)
        action.setToolTip(self.tr("As PNG, SVG, PDF or CSV, with the scene inside."))
        self._export.insertAction(self._last, action)
        self.figures[name] = self._menus.actions[f"export_{name}"] = action
        return action

    def _make_edit(self) -> None:
        menu = self._menus.tops["edit"]
        menu.addSeparator()
        self._add(menu, "copy_figure", self.tr("Copy fi&gure"), self.tr("Ctrl+Shift+C"))
        menu.addSeparator()
        hold = self._add(menu, "hold_brightness", self.tr("&Hold brightness"), self.tr("Ctrl+B"))
        hold.setCheckable(True)
        hold.setToolTip(self.tr("While on, the ISO speed moves against the exposure time."))
        self._add(menu, "reset_scene", self.tr("Reset &scene"))

    def _make_view(self) -> None:
        menu = self._menus.tops["view"]
        before = menu.actions()[1] if len(menu.actions()) > 1 else None
        theme = QMenu(self.tr("&Theme"), menu)
        words = {
            "system": self.tr("&System"), "light": self.tr("&Light"), "dark": self.tr("&Dark"),
        }  # fmt: skip
        self.themes = QActionGroup(self)
        for key in THEMES:
            action = self._add(theme, f"theme_{key}", words[key])
            action.setCheckable(True)
            action.setData(key)
            self.themes.addAction(action)
        self._menus.actions["theme_system"].setChecked(True)
        reset = QAction(self.tr("&Reset layout"), menu)
        self._menus.actions["reset_layout"] = reset
        if before is None:
            menu.addMenu(theme)
            menu.addAction(reset)
        else:
            menu.insertMenu(before, theme)
            menu.insertAction(before, reset)

    def _make_help(self) -> None:
        menu = self._menus.tops["help"]
        self._add(menu, "shortcuts", self.tr("&Keyboard shortcuts…"), self.tr("F1"))
        self._add(menu, "palette", self.tr("Find a &command…"), self.tr("Ctrl+Shift+P"))

"""All commands of the menus, and all parameters, for those who look for one."""

from collections.abc import Callable, Iterator

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QAbstractSpinBox, QLineEdit, QMenu, QMenuBar, QTabWidget, QWidget

from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.parameter_rows import ParameterRow
from occ_gui.window.command_palette import Command
from occ_model.scene.parameters import PARAMETERS

_NATIVE = QKeySequence.SequenceFormat.NativeText


def plain(text: str) -> str:
    """Write a menu entry's text without the marks of its keys."""
    return text.replace("&&", "\0").replace("&", "").replace("\0", "&")


def entries(menu: QMenu | QMenuBar, path: str = "") -> Iterator[tuple[str, QAction]]:
    """Give the entries of a menu and of those in it, each with the menus that lead to it."""
    for action in menu.actions():
        inner = action.menu()
        if isinstance(inner, QMenu):
            name = plain(action.text())
            yield from entries(inner, f"{path} > {name}" if path else name)
        elif not action.isSeparator():
            yield path, action


def sheet_of(bar: QMenuBar) -> Iterator[tuple[str, str, str]]:
    """Give menu, text and keys of every entry that has keys."""
    for path, action in entries(bar):
        keys = ", ".join(key.toString(_NATIVE) for key in action.shortcuts())
        if keys:
            yield path, plain(action.text()).rstrip("…"), keys


def commands_of(
    bar: QMenuBar, controls: ControlPanel, bring_to_front: Callable[[str], None]
) -> list[Command]:
    """List what the menus can do now, and the parameters to jump to.

    Parameters
    ----------
    bar
        The menus.
    controls
        The parameters' controls.
    bring_to_front
        Shows a pane by its name.
    """
    found = [
        Command(
            f"{path}: {plain(action.text())}", action.shortcut().toString(_NATIVE), action.trigger
        )
        for path, action in entries(bar)
        if action.isEnabled()
    ]
    for page, panel in controls.panels.items():
        for name, row in panel.rows.items():
            found.append(_jump(page, name, row, bring_to_front))
    return found


def _jump(
    page: str, name: str, row: ParameterRow, bring_to_front: Callable[[str], None]
) -> Command:
    declared = PARAMETERS[name]

    def jump() -> None:
        bring_to_front("controls")
        _show_page_of(row)
        field: QWidget = getattr(row, "field")  # noqa: B009 - each kind of row has one of its own
        field.setFocus()
        if isinstance(field, QAbstractSpinBox | QLineEdit):
            field.selectAll()

    symbol = f" {declared.symbol}" if declared.symbol else ""
    return Command(f"{page}: {declared.label}{symbol}", "", jump)


def _show_page_of(widget: QWidget) -> None:
    """Turn to the page that a control is on."""
    page: QWidget | None = widget
    while page is not None:
        around = page.parentWidget()
        pages = around.parentWidget() if around is not None else None
        if isinstance(pages, QTabWidget):
            pages.setCurrentWidget(page)
            return
        page = around

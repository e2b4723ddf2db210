"""Style sheet of the window: frames, paddings and focus, on a grid of 8 pixels.

All colours are roles of the palette, written ``palette(role)``. They are replaced by colours here,
because Qt would keep those of the first theme for filled backgrounds.
"""

import re

from PySide6.QtGui import QPalette

from occ_model.files.resources import resource_path

SHEET = """
QToolBar {
    border: none; border-bottom: 1px solid palette(midlight); padding: 2px 4px; spacing: 4px;
}
QToolBar::separator { background: palette(midlight); width: 1px; margin: 6px 2px; }
QToolBar QToolButton {
    padding: 5px; border: 1px solid transparent; border-radius: 6px; background: transparent;
}
QToolBar QToolButton::menu-indicator { image: url("{icons}/down.svg"); width: 8px; height: 8px; }
QToolBar QToolButton:hover:enabled { background: palette(midlight); }
QToolBar QToolButton:checked { background: palette(midlight); border-color: palette(mid); }
QToolBar QToolButton:focus { border: 2px solid palette(accent); padding: 4px; }

QTabBar#modes { background: transparent; }
QTabBar#modes::tab {
    padding: 6px 7px; margin-right: 2px; border: 2px solid transparent; border-radius: 6px;
}
QTabBar#modes::tab:hover:!selected { background: palette(midlight); }
QTabBar#modes::tab:selected {
    background: palette(base); border: 1px solid palette(mid); padding: 6px 8px;
    border-bottom: 3px solid palette(accent);
}
QTabBar#modes::tab:selected:focus { border: 2px solid palette(accent); padding: 6px 7px; }

QPushButton {
    padding: 5px 9px; border: 1px solid palette(mid); border-radius: 4px;
    background: palette(button);
}
QPushButton:hover:enabled { background: palette(midlight); }
QPushButton:pressed { background: palette(midlight); border-color: palette(window-text); }
QPushButton:checked, QPushButton:checked:hover:enabled, QPushButton:checked:pressed {
    background: palette(highlight); color: palette(highlighted-text);
}
QPushButton:checked:hover:enabled { border-color: palette(window-text); }
QPushButton#way:checked { background: palette(button); color: palette(button-text); }
QPushButton#way:checked:hover:enabled {
    background: palette(midlight); color: palette(button-text); border-color: palette(mid);
}
QPushButton:disabled { border-color: palette(midlight); }
QPushButton:focus { border: 2px solid palette(accent); padding: 4px 8px; }
QPushButton#step { border-radius: 13px; padding: 5px 4px; background: transparent; }
QPushButton#step[current="true"] {
    background: palette(highlight); color: palette(highlighted-text);
    border-color: palette(highlight); font-weight: 600;
}
QPushButton#step:focus { border: 2px solid palette(window-text); padding: 4px 3px; }

QLineEdit, QAbstractSpinBox, QComboBox {
    border: 1px solid palette(mid); border-radius: 4px; background: palette(base);
    padding: 1px 6px; selection-background-color: palette(highlight);
}
QAbstractSpinBox { padding: 1px 0px 1px 4px; }
QAbstractSpinBox QLineEdit, QComboBox QLineEdit { border: none; padding: 0px; }
QLineEdit:focus, QAbstractSpinBox:focus, QComboBox:focus {
    border: 2px solid palette(accent); padding: 0px 5px;
}
QAbstractSpinBox:focus { padding: 0px 0px 0px 3px; }
QAbstractSpinBox QLineEdit:focus { border: none; padding: 0px; }
QLineEdit:disabled, QAbstractSpinBox:disabled, QComboBox:disabled {
    border-color: palette(midlight); background: palette(window);
}
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button {
    width: 16px; border: none; background: transparent; subcontrol-origin: border;
}
QAbstractSpinBox::up-button { subcontrol-position: top right; }
QAbstractSpinBox::down-button { subcontrol-position: bottom right; }
QAbstractSpinBox::up-button:hover, QAbstractSpinBox::down-button:hover {
    background: palette(midlight);
}
QAbstractSpinBox::up-arrow { image: url("{icons}/up.svg"); width: 10px; height: 10px; }
QAbstractSpinBox::down-arrow { image: url("{icons}/down.svg"); width: 10px; height: 10px; }
QComboBox::drop-down { border: none; width: 20px; }
QComboBox::down-arrow { image: url("{icons}/down.svg"); width: 12px; height: 12px; }
QComboBox { combobox-popup: 0; }
QComboBox QAbstractItemView::item { min-height: 20px; padding: 0px 4px; }
QAbstractItemView QComboBox { padding: 0px 4px; min-height: 14px; border-radius: 2px; }

QCheckBox { spacing: 8px; }
QCheckBox::indicator {
    width: 14px; height: 14px; border: 1px solid palette(mid); border-radius: 3px;
    background: palette(base);
}
QCheckBox::indicator:checked {
    background: palette(highlight); border-color: palette(highlight);
    image: url("{icons}/tick.svg");
}
QCheckBox::indicator:disabled { border-color: palette(midlight); background: palette(window); }
QCheckBox::indicator:checked:disabled { background: palette(mid); }
QCheckBox::indicator:focus { border: 2px solid palette(accent); }

QSlider::groove:horizontal { height: 4px; border-radius: 2px; background: palette(mid); }
QSlider::sub-page:horizontal { height: 4px; border-radius: 2px; background: palette(highlight); }
QSlider::handle:horizontal {
    width: 14px; margin: -6px 0px; border: 1px solid palette(base); border-radius: 8px;
    background: palette(highlight);
}
QSlider[tracked="true"]::groove:horizontal, QSlider[tracked="true"]::sub-page:horizontal {
    background: transparent;
}
QSlider::handle:horizontal:focus { border: 3px solid palette(window-text); }
QSlider::sub-page:horizontal:disabled, QSlider::handle:horizontal:disabled {
    background: palette(mid);
}

QDockWidget {
    titlebar-close-icon: url("{icons}/close.svg"); titlebar-normal-icon: url("{icons}/float.svg");
}
QDockWidget::title { padding: 4px 8px; background: palette(window); text-align: left; }
QDockWidget::close-button, QDockWidget::float-button { border: none; icon-size: 14px; }
QDockWidget QAbstractButton#qt_dockwidget_closebutton:focus,
QDockWidget QAbstractButton#qt_dockwidget_floatbutton:focus { border: 2px solid palette(accent); }
QMainWindow::separator { background: palette(window); width: 6px; height: 6px; }
QMainWindow::separator:hover { background: palette(highlight); }

QFrame#card { background: palette(base); border: 1px solid palette(mid); border-radius: 8px; }

QTabWidget::pane { border: none; border-top: 1px solid palette(midlight); }
QTabBar::tab {
    padding: 5px 8px; border: none; border-bottom: 2px solid transparent;
    background: transparent;
}
QTabBar::tab:hover:!selected { background: palette(midlight); }
QTabBar::tab:selected { border-bottom: 2px solid palette(accent); }
QTabBar::tab:selected:focus { background: palette(midlight); }
QMainWindow > QTabBar::tab { border-top: 2px solid transparent; border-bottom: none; }
QMainWindow > QTabBar::tab:selected { border-top: 2px solid palette(accent); }

QProgressBar {
    border: 1px solid palette(mid); border-radius: 4px; background: palette(base);
    text-align: center;
}
QProgressBar::chunk { background: palette(highlight); border-radius: 3px; }
QStatusBar { border-top: 1px solid palette(midlight); }
QStatusBar::item { border: none; }
QScrollBar:vertical { width: 12px; background: transparent; }
QScrollBar:horizontal { height: 12px; background: transparent; }
QScrollBar::handle {
    background: palette(mid); border-radius: 4px; margin: 2px; min-width: 24px; min-height: 24px;
}
QScrollBar::add-line, QScrollBar::sub-line, QScrollBar::add-page, QScrollBar::sub-page {
    width: 0px; height: 0px; background: transparent;
}
QToolTip {
    border: 1px solid palette(mid); padding: 4px;
    background: palette(tooltip-base); color: palette(tooltip-text);
}
"""


_ROLE = re.compile(r"palette\(([\w-]+)\)")


def style_sheet(palette: QPalette) -> str:
    sheet = SHEET.replace("{icons}", resource_path("icons", "style").as_posix())
    return _ROLE.sub(lambda match: _colour(palette, match[1]), sheet)


def _colour(palette: QPalette, words: str) -> str:
    """Return the colour of a role, whose name is written as in a style sheet of Qt."""
    name = "".join(word.capitalize() for word in words.replace("tooltip", "tool-tip").split("-"))
    return palette.color(QPalette.ColorRole[name]).name()

"""Colour theme and text size of the application."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QWidget

from occ_gui.values.choices import THEMES
from occ_gui.widgets.building import resize_font

_SCHEMES = dict(
    zip(THEMES, (Qt.ColorScheme.Unknown, Qt.ColorScheme.Light, Qt.ColorScheme.Dark), strict=True)
)
_STYLE = "fusion"  # the style that follows any palette, on every system

_ROLE = QPalette.ColorRole

_COLOURS = {  # the colours of each role: in the light theme, and in the dark one
    _ROLE.Window: ("#f3f4f6", "#1f2226"), _ROLE.WindowText: ("#1a1c1f", "#eceef0"),
    _ROLE.Base: ("#ffffff", "#141619"), _ROLE.AlternateBase: ("#f7f8f9", "#1a1d20"),
    _ROLE.Text: ("#1a1c1f", "#eceef0"), _ROLE.Button: ("#ffffff", "#2c3036"),
    _ROLE.ButtonText: ("#1a1c1f", "#f4f5f6"), _ROLE.BrightText: ("#ffffff", "#ffffff"),
    _ROLE.Highlight: ("#0f62ad", "#2b76c9"), _ROLE.HighlightedText: ("#ffffff", "#ffffff"),
    _ROLE.ToolTipBase: ("#ffffff", "#32363d"), _ROLE.ToolTipText: ("#1a1c1f", "#eceef0"),
    _ROLE.Link: ("#0b57a0", "#7ab8f5"), _ROLE.LinkVisited: ("#6b2fa0", "#c0a6f2"),
    _ROLE.PlaceholderText: ("#666b73", "#9aa0a8"), _ROLE.Light: ("#ffffff", "#3a3f47"),
    _ROLE.Midlight: ("#dfe2e6", "#353a41"), _ROLE.Mid: ("#80858e", "#7e858f"),
    _ROLE.Dark: ("#b9bdc4", "#3a3f47"), _ROLE.Shadow: ("#767676", "#000000"),
    _ROLE.Accent: ("#0f62ad", "#4a94e0"),
}  # fmt: skip
_DISABLED = {"dark": "#7d838b", "light": "#8f949b"}
_FADED = (_ROLE.WindowText, _ROLE.Text, _ROLE.ButtonText)


def palette_of(theme: str) -> QPalette:
    palette = QPalette()
    for role, colours in _COLOURS.items():
        palette.setColor(role, QColor(colours[theme == "dark"]))
    for role in _FADED:
        palette.setColor(QPalette.ColorGroup.Disabled, role, QColor(_DISABLED[theme]))
    return palette


class ThemeController(QObject):
    """Sets the application's colours: the system's until another theme is chosen."""

    chosen = Signal(str)  # the theme that is shown from now on, one of THEMES
    colours_changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.theme = "system"
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.styleHints().colorSchemeChanged.connect(self._follow_system)
        show_theme(self.theme)

    def choose(self, theme: str) -> None:
        """Change to a theme; an unknown name means the system's."""
        theme = theme if theme in THEMES else "system"
        if theme == self.theme:
            return
        self.theme = theme
        if show_theme(theme):
            self.colours_changed.emit()
            self.chosen.emit(theme)

    def _follow_system(self) -> None:
        if self.theme == "system":
            show_theme(self.theme)
            self.colours_changed.emit()


def show_theme(theme: str) -> bool:
    """Draw the application in a theme, one of THEMES; return whether there is an application."""
    application = QApplication.instance()
    if not isinstance(application, QApplication):  # there is no window
        return False
    hints = application.styleHints()
    hints.setColorScheme(_SCHEMES[theme])
    if theme == "system":
        theme = "dark" if hints.colorScheme() == Qt.ColorScheme.Dark else "light"
    if application.style().objectName() != _STYLE:
        application.setStyle(_STYLE)
    palette = palette_of(theme)
    # All colours are compared, because the cache key ignores the text of disabled widgets.
    if application.palette() != palette:
        application.setPalette(palette)
    return True


SIZES = (100, 115, 130)  # percent of the system's size of text, the normal one first

_SET_FONT = Qt.WidgetAttribute.WA_SetFont
_HAS_SIZE = 0x0002  # the bit of Qt's resolve mask of a font whose size is set


class TextSize(QObject):
    """The size of all text, relative to that of the system.

    All text sizes are multiples of the application's font size. Existing widgets are scaled with
    it, and new widgets start with it.
    """

    chosen = Signal(int)  # the size from now on, one of SIZES

    def __init__(self) -> None:
        super().__init__()
        self.percent = SIZES[0]

    def enlarge(self) -> None:
        self.choose(SIZES[min(SIZES.index(self.percent) + 1, len(SIZES) - 1)])

    def reduce(self) -> None:
        self.choose(SIZES[max(SIZES.index(self.percent) - 1, 0)])

    def reset(self) -> None:
        self.choose(SIZES[0])

    def choose(self, percent: int) -> None:
        """Change the size and emit a signal; a size not among SIZES changes nothing."""
        if percent not in SIZES:
            return
        if percent != self.percent:
            self._scale_to(percent)
        self.chosen.emit(percent)

    def _scale_to(self, percent: int) -> None:
        factor = percent / self.percent
        self.percent = percent
        fonts = [(widget, resize_font(widget.font(), factor)) for widget in _list_own_sizes()]
        QApplication.setFont(resize_font(QApplication.font(), factor))
        for widget, font in fonts:
            widget.setFont(font)


def _list_own_sizes() -> list[QWidget]:
    """Return the widgets whose text size was set, and is not inherited."""
    return [
        widget
        for widget in QApplication.allWidgets()
        if widget.testAttribute(_SET_FONT) and widget.font().resolveMask() & _HAS_SIZE
    ]

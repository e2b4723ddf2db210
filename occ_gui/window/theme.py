"""Colour theme of the application: that of the system, light or dark."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication

THEMES = ("system", "light", "dark")
"""Names of the themes; the first follows the system."""

_SCHEMES = dict(
    zip(THEMES, (Qt.ColorScheme.Unknown, Qt.ColorScheme.Light, Qt.ColorScheme.Dark), strict=True)
)

_ROLE = QPalette.ColorRole

_DARK = {
    _ROLE.Window: "#343434", _ROLE.WindowText: "#ececec", _ROLE.Base: "#1c1c1c",
    _ROLE.AlternateBase: "#262626", _ROLE.Text: "#ececec", _ROLE.Button: "#525252",
    _ROLE.ButtonText: "#ffffff", _ROLE.BrightText: "#ffffff", _ROLE.Highlight: "#2f7fc0",
    _ROLE.HighlightedText: "#ffffff", _ROLE.ToolTipBase: "#3a3a3a", _ROLE.ToolTipText: "#ececec",
    _ROLE.Link: "#6cb6f5", _ROLE.LinkVisited: "#b79cf0", _ROLE.PlaceholderText: "#9a9a9a",
    _ROLE.Light: "#4a4a4a", _ROLE.Midlight: "#404040", _ROLE.Mid: "#7a7a7a",
    _ROLE.Dark: "#161616", _ROLE.Shadow: "#000000", _ROLE.Accent: "#2f7fc0",
}  # fmt: skip
_LIGHT = {
    _ROLE.Window: "#efefef", _ROLE.WindowText: "#000000", _ROLE.Base: "#ffffff",
    _ROLE.AlternateBase: "#f7f7f7", _ROLE.Text: "#000000", _ROLE.Button: "#efefef",
    _ROLE.ButtonText: "#000000", _ROLE.BrightText: "#ffffff", _ROLE.Highlight: "#308cc6",
    _ROLE.HighlightedText: "#ffffff", _ROLE.ToolTipBase: "#ffffdc", _ROLE.ToolTipText: "#000000",
    _ROLE.Link: "#0000ff", _ROLE.LinkVisited: "#800080", _ROLE.PlaceholderText: "#7f7f7f",
    _ROLE.Light: "#ffffff", _ROLE.Midlight: "#cacaca", _ROLE.Mid: "#b8b8b8",
    _ROLE.Dark: "#9f9f9f", _ROLE.Shadow: "#767676", _ROLE.Accent: "#308cc6",
}  # fmt: skip
_SYSTEMS = "systemsStyleAndPalette"
"""Application property that stores the system's style and palette while another theme is shown."""

_BOX = "#8a8a8a"
"""Colour of an empty check box in the dark theme: a contrast of 3.6 to the window."""

_DISABLED = {"dark": "#7f7f7f", "light": "#a0a0a0"}
_FADED = (_ROLE.WindowText, _ROLE.Text, _ROLE.ButtonText)


def palette_of(theme: str) -> QPalette:
    """Make the palette of the light or the dark theme."""
    palette = QPalette()
    for role, colour in (_DARK if theme == "dark" else _LIGHT).items():
        palette.setColor(role, QColor(colour))
    for role in _FADED:
        palette.setColor(QPalette.ColorGroup.Disabled, role, QColor(_DISABLED[theme]))
    return palette


def _boxed(palette: QPalette) -> QPalette:
    """Make empty check boxes visible: Fusion draws their frames darker than the window."""
    palette.setColor(_ROLE.Base, QColor(_BOX))
    return palette


class ThemeController(QObject):
    """Sets the application's colours.

    A theme that is not the system's is drawn in the style Fusion, which applies any palette.
    """

    chosen = Signal(str)
    """The theme that is shown from now on, one of THEMES."""

    def __init__(self) -> None:
        super().__init__()
        self.theme = THEMES[0]

    def choose(self, theme: str) -> None:
        """Change to a theme; an unknown name means that of the system."""
        theme = theme if theme in THEMES else THEMES[0]
        if theme == self.theme:
            return
        self.theme = theme
        application = QApplication.instance()
        if not isinstance(application, QApplication):  # there is no window
            return
        application.styleHints().setColorScheme(_SCHEMES[theme])
        if application.property(_SYSTEMS) is None:
            found = (application.style().objectName(), application.palette())
            application.setProperty(_SYSTEMS, found)
        if theme == THEMES[0]:
            style, palette = application.property(_SYSTEMS)
            application.setProperty(_SYSTEMS, None)
            application.setStyle(style)
            application.setPalette(palette if _is_followed(application) is None else QPalette())
        else:
            application.setStyle("Fusion")
            application.setPalette(palette_of(theme))
            if theme == "dark":
                # PySide takes a text here, whatever its stubs say.
                application.setPalette(_boxed(palette_of(theme)), "QCheckBox")  # type: ignore[arg-type]
        self.chosen.emit(theme)


def _is_followed(application: QApplication) -> bool | None:
    """Return True where Qt follows the system's colours, None where it does not."""
    return None if application.styleHints().colorScheme() == Qt.ColorScheme.Unknown else True

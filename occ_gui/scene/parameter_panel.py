"""Parameter panel: a form of labelled parameter rows, and the page that contains it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSpacerItem, QVBoxLayout, QWidget

from occ_gui.scene.parameter_rows import ParameterRow, QuantityRow, explain, row_for
from occ_gui.scene.player import PlayButton
from occ_gui.scene.slider_scale import SliderScale
from occ_gui.widgets.building import ScrollPane, embolden, fill
from occ_gui.widgets.event_filters import leave_drops_to_window
from occ_model.results.teaching import MarkedValue
from occ_model.scene.colour_scenes import is_colour
from occ_model.scene.parameter_kinds import Parameter, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, Scene, Transmitter

_OF_COLOURS = frozenset(GROUPS["colours"]) - {"bayer"}
"""Parameters of a colour camera only."""

_SPACE_ABOVE = 6  # pixels above the label of each row but the first

_MARGINS = (9, 9, 9, 2)  # pixels around the rows; the pane adds a margin below them


class ParameterPanel(QWidget):
    """Rows of controls for some of the parameters, created from their declarations."""

    def __init__(
        self,
        names: Iterable[str],
        headings: Mapping[str, str] = MappingProxyType({}),
        *,
        with_scales: bool = False,
    ) -> None:
        super().__init__()
        self._scales: dict[str, SliderScale] = {}
        self.play_buttons: dict[str, PlayButton] = {}
        self.rows: dict[str, ParameterRow] = {}
        self.labels: dict[str, QLabel] = {}
        self._spaces: dict[str, QSpacerItem] = {}
        self._shown_for = ("", False)
        layout = fill(QVBoxLayout(self), margins=_MARGINS, spacing=2)
        for name in names:
            self._spaces[name] = QSpacerItem(0, _SPACE_ABOVE)
            layout.addItem(self._spaces[name])
            if name in headings:
                layout.addWidget(_make_heading(headings[name]))
            row = row_for(PARAMETERS[name])
            self.rows[name] = row
            self.labels[name] = _make_label(PARAMETERS[name])
            line = QHBoxLayout()
            line.addWidget(self.labels[name], 1)
            layout.addLayout(line)
            layout.addWidget(row)
            if with_scales and isinstance(row, QuantityRow):
                self._add_scale(name, row, line)
        layout.addStretch(1)
        self.show_light(Transmitter().light)

    def show_light(self, light: str, *, has_colours: bool = False) -> None:
        """Show the rows of scenes with this kind of light, and those of three colours."""
        if (light, has_colours) == self._shown_for:
            return
        self._shown_for = light, has_colours
        space_above = 0
        for name, row in self.rows.items():
            is_shown = PARAMETERS[name].is_of(light) and (has_colours or name not in _OF_COLOURS)
            for part in (row, self.labels[name], self.play_buttons.get(name)):
                if part is not None:
                    part.setVisible(is_shown)
            self._spaces[name].changeSize(0, space_above if is_shown else 0)
            space_above = _SPACE_ABOVE if is_shown else space_above
        layout = self.layout()
        if layout is not None:
            layout.invalidate()

    def _add_scale(self, name: str, row: QuantityRow, line: QHBoxLayout) -> None:
        declared = PARAMETERS[name]
        if isinstance(declared, Quantity):
            self._scales[name] = SliderScale(row.slider, declared)
            row.add_below(self._scales[name])
            self.play_buttons[name] = PlayButton(name, declared.label)
            line.addWidget(self.play_buttons[name])

    def add_foot(self, widget: QWidget) -> None:
        layout = self.layout()
        if layout is not None:
            layout.addWidget(widget)

    def show_scene(self, scene: Scene) -> None:
        self.show_light(scene.transmitter.light, has_colours=is_colour(scene))
        for name in ("levels", "switching_frequency"):  # unused if a recorded waveform is sent
            if name in self.rows:
                self.rows[name].setEnabled(not replaces_levels(scene))
        for name, row in self.rows.items():
            value = scene.value(name)
            if value != row.value:
                row.show_value(value)

    def show_marks(self, name: str, marks: Sequence[MarkedValue]) -> None:
        if name in self._scales:
            self._scales[name].show_marks(marks)


def replaces_levels(scene: Scene) -> bool:
    """Whether a recorded waveform is sent in place of levels at the switching frequency."""
    return scene.transmitter.light == "waveform" and bool(scene.transmitter.waveform_file)


def _make_heading(text: str) -> QLabel:
    label = embolden(QLabel(text))
    label.setContentsMargins(0, 8, 0, 4)
    return label


def _make_label(declared: Parameter) -> QLabel:
    text = declared.label
    if declared.symbol:
        base, _, index = declared.symbol.partition("_")
        text += f" <i>{base}</i><sub>{index}</sub>" if index else f" <i>{base}</i>"
    label = QLabel(text, textFormat=Qt.TextFormat.RichText)
    label.setToolTip(explain(declared))
    return label


_LEAST_SIZE = QSize(100, 80)  # of a page in pixels; rows that need more are scrolled


class ParameterPage(ScrollPane):
    """A page with the controls of some parameters; by default without headings."""

    made = Signal(object)  # its controls have been made: the ParameterPanel

    def __init__(
        self, names: Sequence[str], make: Callable[[], ParameterPanel] | None = None
    ) -> None:
        super().__init__(least=_LEAST_SIZE)
        self.names = names
        self.content: ParameterPanel | None = None
        self._make = make or (lambda: ParameterPanel(names))

    def panel(self) -> ParameterPanel:
        if self.content is None:
            self.content = self._make()
            self.setWidget(self.content)
            self.updateGeometry()
            leave_drops_to_window(self)
            self.made.emit(self.content)
        return self.content

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        self.panel()
        super().showEvent(event)

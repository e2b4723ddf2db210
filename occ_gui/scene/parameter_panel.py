"""Parameter panel: a form of parameter rows with their labels."""

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from occ_gui.scene.parameter_rows import ParameterRow, explain, row_for
from occ_model.scene.parameter_kinds import Parameter
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene


class ParameterPanel(QWidget):
    """Rows of controls for some of the parameters, created from their declarations.

    Parameters
    ----------
    names
        The parameters, in the order shown.
    parent
        The parent widget.
    """

    def __init__(self, names: Iterable[str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows: dict[str, ParameterRow] = {}
        self.labels: dict[str, QLabel] = {}
        layout = QVBoxLayout(self)
        layout.setSpacing(2)
        for name in names:
            row = row_for(PARAMETERS[name])
            self.rows[name] = row
            self.labels[name] = _label(PARAMETERS[name])
            layout.addWidget(self.labels[name])
            layout.addWidget(row)
            layout.addSpacing(6)
        layout.addStretch(1)

    def show_scene(self, scene: Scene) -> None:
        """Show a scene: each row whose value differs from the scene's shows the new one."""
        for name, row in self.rows.items():
            value = scene.value(name)
            if value != row.value:
                row.show_value(value)


def _label(declared: Parameter) -> QLabel:
    text = declared.label
    if declared.symbol:
        base, _, index = declared.symbol.partition("_")
        text += f" <i>{base}</i><sub>{index}</sub>" if index else f" <i>{base}</i>"
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.RichText)
    label.setToolTip(explain(declared))
    return label

"""Spotlight: frames one control, scrolls it into view, and dims and disables the others."""

from PySide6.QtCore import QMargins, QObject, Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QGraphicsOpacityEffect, QWidget

from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.parameter_panel import ParameterPanel
from occ_gui.widgets.building import bring_into_view
from occ_gui.widgets.frame_over import FrameOver
from occ_model.scene.parameters import PARAMETERS

_DIMMING = 0.75  # opacity of the other controls
_MARGINS = QMargins(4, 4, 4, 4)


class Spotlight(QObject):
    def __init__(self, controls: ControlPanel) -> None:
        super().__init__(controls)
        self._controls = controls
        self._dimmed: list[QWidget] = []
        self._disabled: list[QWidget] = []
        self._tool_tips: list[tuple[QWidget, str]] = []
        self._frame: FrameOver | None = None

    @property
    def is_on(self) -> bool:
        return self._frame is not None

    def show_only(self, name: str) -> None:
        """Mark the control of a parameter; an unknown or empty name marks none."""
        self.end()
        for panel in self._controls.panels.values():
            if name in panel.rows:
                self._mark(panel, name)

    def end(self) -> None:
        for widget in self._dimmed:
            # None removes the effect; the stubs of PySide do not allow it.
            widget.setGraphicsEffect(None)  # type: ignore[arg-type]
        for widget in self._disabled:
            widget.setEnabled(True)
        for widget, tool_tip in self._tool_tips:
            widget.setToolTip(tool_tip)
        self._dimmed, self._disabled, self._tool_tips = [], [], []
        if self._frame is not None:
            self._frame.hide()
            self._frame.setParent(None)
            self._frame.deleteLater()
            self._frame = None

    def _mark(self, panel: ParameterPanel, name: str) -> None:
        row, label = panel.rows[name], panel.labels[name]
        bring_into_view(row, 4 * _MARGINS.top())
        children = panel.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly)
        kept_widgets = (row, label, panel.play_buttons.get(name))
        reason = (
            f"This step of the lesson is about “{PARAMETERS[name].label}”. The other "
            "controls of this page are disabled until you leave it."
        )
        for widget in children:
            if widget not in kept_widgets:
                self._dim(widget, reason)
        self._frame = FrameOver(
            panel, row, lambda: label.geometry().united(row.geometry()).marginsAdded(_MARGINS),
            lambda colours: colours.color(QPalette.ColorRole.Highlight), radius=4,
        )  # fmt: skip
        self._frame.raise_()
        self._frame.show()

    def _dim(self, widget: QWidget, reason: str) -> None:
        """Dim and disable a widget, with the reason as its tooltip."""
        effect = QGraphicsOpacityEffect(widget, opacity=_DIMMING)
        widget.setGraphicsEffect(effect)
        self._dimmed.append(widget)
        if widget.isEnabledTo(self._controls):
            widget.setEnabled(False)
            self._disabled.append(widget)
        for part in (widget, *widget.findChildren(QWidget)):
            if part.toolTip():
                self._tool_tips.append((part, part.toolTip()))
                part.setToolTip(f"{reason}\n\n{part.toolTip()}")

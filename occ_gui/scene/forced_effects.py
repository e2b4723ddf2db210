"""Forced effects: a line of the effects switched by hand, with a button that resets them."""

from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from occ_gui.widgets.building import filled, paragraph, push_button


def switch_text(effect: str, included: bool | None, labels: Mapping[str, str]) -> str:
    """Describe how an effect is switched: on or off by hand, or by the plan (None)."""
    how = {True: "on by hand", False: "off by hand", None: "as planned"}[included]
    return f"{labels.get(effect, effect)} {how}"


def forced_text(force: Mapping[str, bool], labels: Mapping[str, str]) -> str:
    places = {name: place for place, name in enumerate(labels)}
    names = sorted(force, key=lambda name: places.get(name, len(places)))
    return ", ".join(switch_text(name, force[name], labels) for name in names)


class ForcedEffects(QWidget):
    """The effects switched by hand, and a button that resets them; hidden without any."""

    released = Signal()  # the user leaves all effects to the plan

    def __init__(self) -> None:
        super().__init__()
        self.text = paragraph(name="Effects switched by hand")
        self.text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        self.back = push_button(
            "Back to the plan",
            "Let the plan decide on these effects again, as one step that can be undone.",
            self.released,
        )
        filled(
            QHBoxLayout(self), (self.text, 1), (self.back, 0, Qt.AlignmentFlag.AlignTop), margins=0
        )
        self.hide()

    def show_list(self, text: str) -> None:
        self.text.setText(text)
        self.setVisible(bool(text))

"""Accuracy settings that the user has changed, in words and in a line of the window."""

import math
from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.widgets.building import fill, paragraph, push_button
from occ_gui.widgets.state_look import Badge, State
from occ_model.errors import capitalize, inflect
from occ_model.scene.scene import SimulationSettings, unit_of

_MOST_NAMED = 1  # switched effects that a badge names


def switch_text(effect: str, included: bool | None, labels: Mapping[str, str]) -> str:
    """Describe how an effect is switched: on, off, or by the plan (None)."""
    state = {True: "switched on", False: "switched off", None: "as planned"}[included]
    return f"{labels.get(effect, effect)} {state}"


def describe_forced(force: Mapping[str, bool], labels: Mapping[str, str]) -> str:
    order = {name: index for index, name in enumerate(labels)}
    names = sorted(force, key=lambda name: order.get(name, len(order)))
    return ", ".join(switch_text(name, force[name], labels) for name in names)


def describe_accuracy(settings: SimulationSettings, labels: Mapping[str, str]) -> str:
    """Describe how the accuracy differs from that of a new window; empty if it does not."""
    texts = (_describe_tolerance(settings), describe_forced(settings.force, labels))
    return capitalize(", ".join(text for text in texts if text))


def _describe_tolerance(settings: SimulationSettings) -> str:
    tolerance, observable = settings.tolerance, settings.observable
    if (tolerance, observable) == (FIRST_SETTINGS.tolerance, FIRST_SETTINGS.observable):
        return ""
    amount = f"tolerance {tolerance:g} {unit_of(observable)}"
    if tolerance == math.inf:
        amount = "paper's model, no effects"
    return amount if observable == FIRST_SETTINGS.observable else f"{amount} of the {observable}"


def accuracy_badge(settings: SimulationSettings, labels: Mapping[str, str]) -> Badge | None:
    """Return the status line's badge; None if nothing is changed."""
    changes = describe_accuracy(settings, labels)
    if not changes:
        return None
    count = len(settings.force)
    forced = describe_forced(settings.force, labels)
    if count > _MOST_NAMED:
        forced = f"{inflect(count, 'effect')} switched"
    text = " · ".join(part for part in (_describe_tolerance(settings), forced) if part)
    meaning = f"{changes}.\nThe mode Effects shows what this changes."
    return Badge("accuracy", text, meaning, State.DOUBTFUL)


class ForcedEffects(QWidget):
    """A list of what is changed, and a button that resets it; hidden if nothing is."""

    released = Signal()  # the user leaves all effects to the plan

    def __init__(self) -> None:
        super().__init__()
        self.text = paragraph(name="Accuracy changed")
        self.text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        self.back = push_button(
            "Back to the plan",
            "Let the plan decide on all effects again, within the usual tolerance.",
            self.released,
        )
        fill(
            QHBoxLayout(self), (self.text, 1), (self.back, 0, Qt.AlignmentFlag.AlignTop), margins=0
        )
        self.hide()

    def show_list(self, text: str) -> None:
        self.text.setText(text)
        self.setVisible(bool(text))

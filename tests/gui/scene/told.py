"""A row of the controls, what it emits, and the quantities that there are rows of."""

from typing import Any

from pytestqt.qtbot import QtBot

from occ_gui.scene.parameter_rows import row_for
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS

QUANTITIES = [declared for declared in PARAMETERS.values() if isinstance(declared, Quantity)]


class Told:
    def __init__(self, name: str, qtbot: QtBot) -> None:
        self.row: Any = row_for(PARAMETERS[name])
        self.edits: list[tuple[str, Any, int]] = []
        self.refused: list[str] = []
        self.row.edited.connect(lambda *edit: self.edits.append(edit))
        self.row.refused.connect(self.refused.append)
        qtbot.addWidget(self.row)
        self.row.show()

    @property
    def values(self) -> list[Any]:
        return [value for _, value, _ in self.edits]

    @property
    def gestures(self) -> set[int]:
        return {gesture for _, _, gesture in self.edits}

"""Workspace: all that the user has set, as one value without results or pixels."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Self

from occ_gui.values.choices import FilmChoice, PhotoChoice, RoomChoice
from occ_gui.values.simulated import Pins
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.frame import PICTURES
from occ_model.results.sweep_request import ShownQuantity
from occ_model.scene.recording import FRAME_RATE
from occ_model.scene.scene import Scene, SimulationSettings

FIRST_SETTINGS = SimulationSettings()
"""The first settings of the window."""


@dataclass(frozen=True, slots=True)
class UndoState:
    """The part of a workspace that undo and redo restore.

    The tolerance is not part of it: it says how exactly a scene is simulated, not what the scene
    is.
    """

    scene: Scene
    force: dict[str, bool]
    room: RoomChoice = field(default_factory=RoomChoice)
    preset: str = field(default="", compare=False)  # it follows from the changes of the scene

    def put_into(self, workspace: "Workspace") -> "Workspace":
        """Return a workspace with this part replaced."""
        restored = replace(workspace, scene=self.scene, room=self.room, preset=self.preset)
        return restored.with_force(self.force)


@dataclass(frozen=True, slots=True)
class Workspace:
    """What the user has set: the scene, the settings of its simulation, and what panes show."""

    scene: Scene
    settings: SimulationSettings = FIRST_SETTINGS
    frame_rate: float = FRAME_RATE.default
    shown: ShownQuantity = "rate"
    decoder: str = PAPER_DECODER  # the decoder whose result and steps are shown
    picture_kind: str = PICTURES[0]  # the camera's or the receiver's picture, one of PICTURES
    overlay: str = "beside"
    """How a photo is shown with the picture: beside it, or over it in one of several ways."""
    is_enhanced: bool = False  # whether profiles are shown after the receiver's enhancement
    photo: PhotoChoice = field(default_factory=PhotoChoice)
    film: FilmChoice = field(default_factory=FilmChoice)
    room: RoomChoice = field(default_factory=RoomChoice)
    pins: Pins = (None, None)
    preset: str = ""  # the preset from which the scene comes; empty for none
    scene_file: Path | None = None

    def __post_init__(self) -> None:
        # Without a code no bit is decided: the tolerance limits the signal instead.
        if not self.has_code and self.settings.observable == "decision":
            object.__setattr__(self, "settings", replace(self.settings, observable="signal"))

    @property
    def undo_state(self) -> UndoState:
        return UndoState(self.scene, dict(self.settings.force), self.room, self.preset)

    @property
    def has_code(self) -> bool:
        """Whether the scene's light is a code, which map, bench and decoders are about."""
        return self.scene.transmitter.light == "code"

    def with_force(self, force: Mapping[str, bool]) -> Self:
        return replace(self, settings=replace(self.settings, force=dict(force)))

"""Actions of the window that the pane of the photo calls."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from occ_model.scene.parameter_kinds import ParameterValue

if TYPE_CHECKING:
    from occ_gui.photo.match_controller import MatchController


@dataclass(frozen=True, kw_only=True)
class WindowActions:
    ask_for_photo: Callable[[], object]
    samples: Callable[[], Mapping[str, Path]]  # returns the sample photos by description
    open_sample: Callable[[Path], object]
    # takes name, value in SI units, and the number of the gesture
    edit_scene: Callable[[str, ParameterValue, int], object]
    save_match: "Callable[[MatchController], object]"
    save_table: Callable[[str], object]

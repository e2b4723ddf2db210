"""Modes: a layout of the window for each task, and the places that panes declare in them."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, TypeAlias

STORY, PICTURE = "story", "picture"
"""The pages in the middle: the story from light to bits, and the picture with the photo."""

Side: TypeAlias = Literal["left", "right", "bottom"]


@dataclass(frozen=True, slots=True)
class Mode:
    centre: str  # the page in the middle; empty where the panes around it fill the window
    is_bottom_wide: bool = False  # whether the lower left corner belongs to the bottom side
    is_right_high: bool = False  # whether the lower right corner belongs to the right side


MODES: Mapping[str, Mode] = MappingProxyType(
    {
        "explore": Mode(STORY),
        "photo": Mode(PICTURE, is_bottom_wide=True),
        "limits": Mode(""),
        "effects": Mode(""),
        # A lesson's text has all the height, whatever pane it shows below.
        "lessons": Mode(STORY, is_bottom_wide=True, is_right_high=True),
        "video": Mode(""),
        "room": Mode(""),
    }
)


@dataclass(frozen=True, slots=True)
class PanePlace:
    """Where a mode shows a pane initially, as a tab beside the others of that side."""

    side: Side
    is_main: bool = False  # whether this is the mode's main pane, initially in front of the others
    width: int = 0  # initial size in pixels; 0 if it does not matter
    height: int = 0


Places: TypeAlias = Mapping[str, PanePlace]
"""The places of a pane by mode, in those modes that show it initially."""

"""Modes: which panes a task needs, and where they stand until the user moves them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

STORY, PICTURE = "story", "picture"
"""The pages in the middle: the way from light to bits, and the picture with the photo."""

Groups = tuple[tuple[str, ...], ...]
"""Panes from top to bottom; those of a group share a place, the first in front."""


@dataclass(frozen=True, slots=True)
class Mode:
    centre: str  # the page in the middle; empty where the panes around it fill the window
    main: str
    left: Groups = ()
    right: Groups = ()
    bottom: Groups = ()
    is_bottom_wide: bool = False
    is_right_high: bool = False
    # First sizes in pixels by pane, of those whose size matters
    widths: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    heights: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def panes(self) -> tuple[str, ...]:
        groups = (*self.left, *self.right, *self.bottom)
        return tuple(name for group in groups for name in group)


MODES: Mapping[str, Mode] = MappingProxyType(
    {
        "explore": Mode(
            centre=STORY,
            main=PICTURE,
            left=(("controls",),),
            widths={"controls": 340},
        ),
        "photo": Mode(
            centre=PICTURE,
            main="photo",
            left=(("photo", "controls"),),
            bottom=(("profile", "photos"),),
            is_bottom_wide=True,
            widths={"photo": 360},
            heights={"profile": 210},
        ),
        "limits": Mode(
            centre="",
            main="map",
            left=(("controls",),),
            right=(("map", "bench", "bands"),),
            widths={"controls": 340},
        ),
        "effects": Mode(
            centre="",
            main="accuracy",
            left=(("controls",),),
            right=(("accuracy",),),
            widths={"controls": 340},
        ),
        "lessons": Mode(
            centre=STORY,
            main="lessons",
            left=(("controls",),),
            right=(("lessons",),),
            is_bottom_wide=True,
            is_right_high=True,  # a lesson's text has all the height, whatever pane it shows below
            widths={"controls": 320, "lessons": 340},
        ),
        "video": Mode(
            centre="",
            main="video",
            left=(("controls",),),
            right=(("video",),),
            widths={"controls": 340},
        ),
        "room": Mode(centre="", main="room", right=(("room",),)),
    }
)

HOMES: Mapping[str, str] = MappingProxyType(
    {mode.main: name for name, mode in MODES.items() if mode.main != PICTURE}
)
"""The mode that is about a pane, by the pane's name."""

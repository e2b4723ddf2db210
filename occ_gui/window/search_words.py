"""Words by which menu entries are found that do not contain them."""

from collections.abc import Mapping
from types import MappingProxyType

from PySide6.QtGui import QAction

_PROPERTY = "search_words"

_FIGURE = "save figure plot pdf png svg csv"
_TEXT = "font zoom bigger size projector"

_WORDS: Mapping[str, str] = MappingProxyType(
    {
        "open_photo": "image picture jpeg heic raw",
        "open_film": "video movie mp4 avi mkv camera",
        "open_scene": "toml load",
        "save_scene": "toml",
        "save_scene_as": "toml",
        "save_picture": "image png export",
        "export_all": _FIGURE,
        "animation": "gif mp4 film video movie play run slider save export",
        "export_": _FIGURE,
        "transmitter": "arduino pico board microcontroller sketch code led",
        "pin_a": "compare",
        "pin_b": "compare",
        "copy_figure": "clipboard",
        "match": "fit measure camera readout",
        "match_all": "batch table several",
        "find_lamps": "led light",
        "region_by_hand": "crop rectangle",
        "show_blend": "overlay",
        "show_split": "overlay wipe",
        "mode_explore": "story simulation",
        "mode_photo": "match camera readout",
        "mode_limits": "map how fast bits bit rate most highest frequency range",
        "mode_effects": "accuracy cost time tolerance noise lens jpeg",
        "mode_lessons": "learn course tutorial teach student lab sheet",
        "mode_video": "film movie camera live mp4",
        "measure": "cursor difference distance",
        "fit": "zoom whole reset",
        "theme_system": "colour color",
        "theme_light": "colour color bright",
        "theme_dark": "colour color night black",
        "full_screen": "projector beamer presentation fullscreen maximize",
        "text_larger": f"larger {_TEXT}",
        "text_smaller": f"smaller {_TEXT}",
        "text_normal": f"reset {_TEXT}",
        "slider_strips": "success rate",
        "lessons": "learn course tutorial teach student lab sheet",
        "report": "bug error problem",
        "shortcuts": "keys hotkeys",
    }
)
"""By the name of the entry, or its beginning where several share them."""


def give_words(name: str, action: QAction) -> None:
    """Let an entry of a menu be found by words that are not its own."""
    words = _WORDS.get(name) or _WORDS.get(f"{name.partition('_')[0]}_", "")
    action.setProperty(_PROPERTY, words)


def words_of(action: QAction) -> str:
    """Return the words by which an entry is found besides its own; empty where there are none."""
    return str(action.property(_PROPERTY) or "")

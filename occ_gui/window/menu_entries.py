"""Entries of the menus: their texts, keys, tips, and the words by which they are found."""

from typing import NamedTuple

from PySide6.QtGui import QKeySequence

FIGURE = "save figure plot pdf png svg csv"
_TEXT = "font zoom bigger size projector"
_LEARN = "learn course tutorial teach student lab sheet"


class Entry(NamedTuple):
    name: str
    text: str
    keys: QKeySequence.StandardKey | str = ""
    tip: str = ""
    words: str = ""  # search words beyond those of its text
    is_checkable: bool = False


_KEYS = QKeySequence.StandardKey
_SEPARATOR = None
OPEN_PHOTO = Entry("open_photo", "Open &photos…", _KEYS.Open, words="image picture jpeg heic raw")
FILE = (
    Entry("close_photo", "&Close photo"),
    Entry("open_film", "Open &film…", "Ctrl+Alt+O", words="video movie mp4 avi mkv camera"),
    Entry("close_film", "C&lose film"),
    _SEPARATOR,
    Entry("open_scene", "Open sc&ene…", "Ctrl+Shift+O", words="toml load"),
    Entry("save_scene", "&Save scene", _KEYS.Save, words="toml"),
    Entry("save_scene_as", "Save scene &as…", "Ctrl+Shift+S", words="toml"),
    Entry("save_picture", "Save simulated p&icture as…", words="image png export"),
    Entry("save_film", "Sa&ve simulated film as…", words="video movie mp4 mkv gif export"),
    _SEPARATOR,
)
EXPORT_ALL = Entry("export_all", "A&ll figures…", "Ctrl+Shift+E", words=FIGURE)
TRANSMITTER_AND_QUIT = (
    Entry(
        "transmitter", "&Transmitter…", words="arduino pico board microcontroller sketch code led"
    ),
    _SEPARATOR,
    Entry("quit", "&Quit", "Ctrl+Q"),
)
PINS = (
    Entry("pin_a", "Pin as &A", "Ctrl+Shift+A", words="compare"),
    Entry("pin_b", "Pin as &B", "Ctrl+Shift+B", words="compare"),
    Entry("go_to_a", "Go &to A"),
    Entry("go_to_b", "Go t&o B"),
    Entry("clear_pins", "C&lear both"),
)
EDIT = (
    _SEPARATOR,
    Entry("copy_figure", "Copy fi&gure", "Ctrl+Shift+C", words="clipboard"),
    _SEPARATOR,
    Entry(
        "hold_brightness", "&Keep the brightness", "Ctrl+B",
        "While on, a longer exposure lowers the ISO speed.", is_checkable=True,
    ),
    Entry("reset_scene", "Reset &scene"),
)  # fmt: skip
PHOTO = (
    Entry("match", "&Match photo", "Ctrl+M", words="fit measure camera readout"),
    Entry("match_all", "Ma&tch all photos", words="batch table several"),
    Entry("find_lamps", "&Find lamps", words="led light"),
    Entry("region_by_hand", "D&raw a region", words="crop rectangle"),
    Entry("whole_photo", "&Whole photo"),
    Entry("apply_match", "&Apply to the scene", "Ctrl+Shift+M"),
    Entry("save_match", "Sa&ve match as preset…"),
    Entry("delete_preset", "D&elete preset…"),
    Entry("use_settings", "&Use this photo's settings"),
    Entry(
        "measure_camera",
        "Measure m&y camera…",
        "",
        "With two pictures of a lit wall; no equipment is needed.",
        "readout rolling shutter mains bars",
    ),
    _SEPARATOR,
)
OVERLAY_TEXTS = {
    "beside": ("&Side by side", "", ""),
    "blend": ("&Blended over the simulation", "", "overlay"),
    "split": ("Sp&lit along a line", "", "overlay wipe"),
    "difference": ("&Difference", "", ""),
}
SCAN_AXIS_TEXTS = {
    "auto": ("&Automatic, from its stripes", "", ""),
    "columns": ("Column by &column", "", ""),
    "lines": ("&Line by line", "", ""),
}
MODE_TEXTS = {
    "explore": ("&Explore", "From the LED's light to the bits.", "story simulation"),
    "photo": ("&Photo", "Find the settings behind your own photo.", "match camera readout"),
    "limits": (
        "&Limits", "How fast a code can be sent and still be read.",
        "map how fast bits bit rate most highest frequency range",
    ),
    "effects": (
        "E&ffects", "What accuracy costs in time.",
        "accuracy cost time tolerance noise lens jpeg",
    ),
    "lessons": ("Le&ssons", "Learn step by step.", _LEARN),
    "video": ("&Video", "Read films, or live from a camera.", "film movie camera live mp4"),
    "room": ("&Room", "Many lamps in one picture: where am I?", ""),
}  # fmt: skip
THEME_TEXTS = {
    "system": ("&System", "", "colour color"),
    "light": ("&Light", "", "colour color bright"),
    "dark": ("&Dark", "", "colour color night black"),
}
LOOK = (
    Entry("fit", "&Fit pictures", "Ctrl+0", words="zoom whole reset"),
    Entry(
        "before", "&Before the change", "Ctrl+Alt+Z",
        "Show the picture before the latest change beside the present one.", is_checkable=True,
    ),
    Entry(
        "measure", "Meas&ure", "Ctrl+Shift+D",
        "Show two cursors that can be dragged, and the distance between them.",
        "cursor difference distance", is_checkable=True,
    ),
)  # fmt: skip
SIZES = (
    Entry(
        "text_larger", "Lar&ger text", _KEYS.ZoomIn,
        "Enlarge all text of the window, for example on a projector.", f"larger {_TEXT}",
    ),
    Entry("text_smaller", "Smaller te&xt", _KEYS.ZoomOut, words=f"smaller {_TEXT}"),
    Entry("text_normal", "&Normal text size", "Ctrl+Alt+0", words=f"reset {_TEXT}"),
    Entry(
        "full_screen", "Fu&ll screen", "F11",
        "Fill the screen with the window, for example on a projector.",
        "projector beamer presentation fullscreen maximize", is_checkable=True,
    ),
    Entry("reset_layout", "&Reset layout"),
    Entry(
        "slider_strips", "&Slider strips", "",
        "Colour each slider by the fraction of bits that would be read there.",
        "success rate", is_checkable=True,
    ),
    _SEPARATOR,
)  # fmt: skip
HELP = (
    Entry("guide", "&User's guide"),
    Entry("about_pane", "About this &pane", "Shift+F1"),
    Entry("welcome", "&Welcome…"),
    Entry("my_lamp", "My lamp makes &bars", words="flicker banding shutter mains dimmed pwm"),
    Entry("lessons", "&Lessons", words=_LEARN),
    Entry("report", "&Report…", words="bug error problem"),
    Entry("about", "&About"),
    Entry("shortcuts", "&Keyboard shortcuts…", "F1", words="keys hotkeys"),
    Entry("palette", "Find a &command…", "Ctrl+Shift+P"),
)

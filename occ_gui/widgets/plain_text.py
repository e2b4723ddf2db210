"""Text from files is shown letter by letter, wherever Qt would read some of it as its own marks."""

import html

from PySide6.QtGui import Qt  # the part of it that knows rich text

from occ_model.errors import one_line

LONGEST = 4000
"""Characters of a text that are shown."""


def in_tool_tip(text: str) -> str:
    """Write a text so that a tooltip or a message shows it as it is, never as rich text."""
    if not Qt.mightBeRichText(text):
        return text
    return f'<p style="white-space: pre">{html.escape(text)}</p>'


def in_menu(text: str) -> str:
    """Write a text so that a menu or a button shows it as it is: ``&`` marks no key."""
    return one_line(text).replace("&", "&&")


def in_title(text: str) -> str:
    """Write a text so that a window's title shows it as it is: ``[*]`` marks no change."""
    return one_line(text).replace("[*]", "[*][*]")

"""README and manual as text, for the tests of them."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
FOLDER = ROOT / "resources" / "docs"
PAGES = sorted(FOLDER.glob("*.md"))


def text_of(path: Path) -> str:
    """Read a document."""
    return path.read_text(encoding="utf-8")


def blocks(text: str, language: str) -> list[str]:
    """Return the blocks of code in a language; '' for those that name none."""
    found = re.findall(r"^```(\w*)\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    return [code for named, code in found if named == language]


def without_code(text: str) -> str:
    """Leave out the blocks of code."""
    return re.sub(r"^ *```.*?^ *```", "", text, flags=re.DOTALL | re.MULTILINE)


def links(text: str) -> list[str]:
    """Return the targets of links and pictures that are not web pages."""
    return re.findall(r"\]\(((?!https?:)[^)]+)\)", without_code(text))

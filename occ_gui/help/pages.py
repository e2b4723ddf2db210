"""The pages of the manual: where they are, their order."""

import re
from pathlib import Path

from occ_model.files.resources import resource_path

CONTENTS = "index.md"

GUIDE = "guide.md"

_LISTED = re.compile(r"^\* \[([^\]]+)\]\(([\w-]+\.md)\)", re.MULTILINE)


def docs_folder() -> Path:
    """Return the folder of the pages; the pictures they show are in a folder beside it.

    Raises OSError where the program was installed without its pages.
    """
    # From an archive, both are copied.
    resource_path("pictures")
    return resource_path("docs")


def pages(folder: Path) -> list[tuple[str, str]]:
    """List title and file name of every page, in the order of the table of contents.

    Raises OSError where the table of contents cannot be read.
    """
    text = (folder / CONTENTS).read_text(encoding="utf-8")
    return [("Contents", CONTENTS), *_LISTED.findall(text)]


def heading_id(text: str) -> str:
    """Return the anchor of a heading, as the usual viewers of Markdown make it."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")

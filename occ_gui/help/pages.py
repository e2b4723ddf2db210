"""The pages of the manual: where they are, their order, and the search in all of them."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from occ_model.files.resources import resource_path

CONTENTS = "index.md"

GUIDE = "guide.md"

_CONTENTS_ENTRY = re.compile(r"^\* \[([^\]]+)\]\(([\w-]+\.md)\)", re.MULTILINE)


def docs_folder() -> Path:
    """Return the folder of the pages."""
    return resource_path("docs")


def pages(folder: Path) -> list[tuple[str, str]]:
    """List title and file name of every page, in the order of the table of contents.

    Raises OSError if the table of contents cannot be read.
    """
    text = (folder / CONTENTS).read_text(encoding="utf-8")
    return [("Contents", CONTENTS), *_CONTENTS_ENTRY.findall(text)]


def heading_id(text: str) -> str:
    """Return the anchor of a heading, as common Markdown viewers make it."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


_HEADING = re.compile(r"#+ (.+)")


@dataclass(frozen=True, slots=True)
class Section:
    title: str
    """The page's title in the table of contents, followed by the heading of a section in it."""
    link: str  # page and heading, such as ``guide.md#set-up-a-scene``
    text: str


def sections(folder: Path) -> list[Section]:
    """Read the sections of all pages, in the order of the table of contents and without it."""
    all_sections = []
    for title, name in pages(folder):
        parts = _divide_page((folder / name).read_text(encoding="utf-8"))
        for place, (heading, text) in enumerate(parts):
            section_title, link = (title, name) if place == 0 else (f"{title}: {heading}", "")
            all_sections.append(
                Section(section_title, link or f"{name}#{heading_id(heading)}", text)
            )
    return all_sections[1:]


def _divide_page(page: str) -> Iterator[tuple[str, str]]:
    """Divide a page into headings and the text below each; a # in an example is no heading."""
    heading, lines, is_example = "", list[str](), False
    for line in page.splitlines():
        is_example ^= line.startswith("```")
        match = None if is_example else _HEADING.match(line)
        if match is None:
            lines.append(line)
            continue
        if heading:
            yield heading, "\n".join(lines)
        heading, lines = match[1], []
    yield heading, "\n".join(lines)


def search(candidates: Sequence[Section], text: str) -> list[Section]:
    """Return the sections that contain every word, first those that contain them in the title."""
    words = text.lower().split()

    def contains_all(passage: str) -> bool:
        return all(word in passage.lower() for word in words)

    matches = [
        section for section in candidates if contains_all(f"{section.title}\n{section.text}")
    ]
    return sorted(matches, key=lambda section: not contains_all(section.title))

"""The manual's pages, their order and search, and a browser for them with links and a style."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QEvent, Qt, QUrl
from PySide6.QtGui import (
    QColor,
    QImage,
    QPalette,
    QResizeEvent,
    QTextBlock,
    QTextBlockFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
    QTextFrameFormat,
    QTextTable,
)
from PySide6.QtWidgets import QTextBrowser

from occ_model.files.resources import resource_path

CONTENTS = "index.md"

GUIDE = "guide.md"

_LISTED = re.compile(r"^\* \[([^\]]+)\]\(([\w-]+\.md)\)", re.MULTILINE)


def docs_folder() -> Path:
    """Return the folder of the pages; raises OSError if the program is installed without them."""
    # If the program runs from an archive, this copies the pictures as well.
    resource_path("pictures")
    return resource_path("docs")


def pages(folder: Path) -> list[tuple[str, str]]:
    """List title and file name of every page, in the order of the table of contents.

    Raises OSError if the table of contents cannot be read.
    """
    text = (folder / CONTENTS).read_text(encoding="utf-8")
    return [("Contents", CONTENTS), *_LISTED.findall(text)]


def heading_id(text: str) -> str:
    """Return the anchor of a heading, as common Markdown viewers make it."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


_HEADING = re.compile(r"#+ (.+)")


@dataclass(frozen=True, slots=True)
class Section:
    title: str
    """The page's title in the table of contents, followed by the heading of a section in it."""
    link: str  # page and heading, such as ``guide.md#set-up-a-scene``
    heading: str
    text: str


def sections(folder: Path) -> list[Section]:
    """Read the sections of all pages, in the order of the table of contents and without it."""
    found = []
    for title, name in pages(folder):
        parts = _parts((folder / name).read_text(encoding="utf-8"))
        for place, (heading, text) in enumerate(parts):
            shown, link = (title, name) if place == 0 else (f"{title}: {heading}", "")
            found.append(Section(shown, link or f"{name}#{heading_id(heading)}", heading, text))
    return found[1:]


def _parts(page: str) -> Iterator[tuple[str, str]]:
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


def search(of: Sequence[Section], text: str) -> list[Section]:
    """Return the sections that contain every word, first those that contain them in the title."""
    words = text.lower().split()

    def has_all(where: str) -> bool:
        return all(word in where.lower() for word in words)

    there = [section for section in of if has_all(f"{section.title}\n{section.text}")]
    return sorted(there, key=lambda section: not has_all(section.title))


_MARGIN = 12
_IMAGE = QTextDocument.ResourceType.ImageResource
_UNKNOWN = QTextDocument.ResourceType.UnknownResource


class HelpBrowser(QTextBrowser):
    """Shows Markdown files on this computer; other links open in the system's browser."""

    def __init__(self) -> None:
        super().__init__()
        self.setOpenExternalLinks(True)
        self.document().setDocumentMargin(_MARGIN)
        self._pictures: dict[str, QImage] = {}
        self.sourceChanged.connect(self._style)

    def doSetSource(  # noqa: N802 - Qt's name
        self,
        name: QUrl | str,
        type: QTextDocument.ResourceType = _UNKNOWN,  # noqa: A002 - Qt's name
    ) -> None:
        """Show a page from its start, or from the heading that the link names."""
        super().doSetSource(name, type)
        url = QUrl(name)
        if url.hasFragment():
            self._scroll_to_heading(url.fragment())

    def _scroll_to_heading(self, wanted: str) -> None:
        block = self.document().begin()
        while block.isValid():
            if block.blockFormat().headingLevel() and heading_id(block.text()) == wanted:
                self.setTextCursor(QTextCursor(block))
                place = self.document().documentLayout().blockBoundingRect(block)
                self.verticalScrollBar().setValue(int(place.top()))
                return
            block = block.next()

    def loadResource(self, type: int, name: QUrl | str) -> object:  # noqa: A002, N802 - Qt's names
        """Read a page or a picture from a file; nothing is fetched from the network."""
        url = self.source().resolved(QUrl(name))
        if not url.isLocalFile():
            return None
        if type != _IMAGE.value:
            return super().loadResource(type, name)
        key = QUrl(name).toString()
        if key not in self._pictures:
            self._pictures[key] = QImage(url.toLocalFile())
        return self._fit_picture(self._pictures[key])

    def _fit_picture(self, picture: QImage) -> QImage:
        """Return a copy of a picture that is no wider than the page."""
        ratio = self.devicePixelRatioF()
        width = int((self.viewport().width() - 2 * _MARGIN - 1) * ratio)
        if picture.width() > width > 0:
            fitted = picture.scaledToWidth(width, Qt.TransformationMode.SmoothTransformation)
        else:
            fitted = picture.copy()
        fitted.setDevicePixelRatio(ratio)
        return fitted

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        if event.size().width() == event.oldSize().width():
            return
        document = self.document()
        for name, picture in self._pictures.items():
            document.addResource(_IMAGE.value, QUrl(name), self._fit_picture(picture))
        document.markContentsDirty(0, document.characterCount())

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._style()

    def _style(self) -> None:
        style_page(self.document(), self.palette())


_CODE = QTextFormat.Property.BlockCodeFence
_CODE_MARGIN, _HEADING_ABOVE, _NEAR = 14, 16, 4


def style_page(document: QTextDocument, palette: QPalette) -> None:
    """Set the margins of headings, the background of code blocks and the lines of tables."""
    ground, line = palette.alternateBase(), palette.mid().color()
    tables: set[int] = set()
    document.pageCount()  # lays out everything first; otherwise Qt leaves out paragraphs
    block = document.begin()
    while block.isValid():
        cursor = QTextCursor(block)
        if block.blockFormat().headingLevel():
            cursor.mergeBlockFormat(_heading_format())
        elif block.blockFormat().hasProperty(_CODE):
            code = _code_format(block)
            code.setBackground(ground)
            cursor.mergeBlockFormat(code)
        elif (table := cursor.currentTable()) is not None and table.firstPosition() not in tables:
            tables.add(table.firstPosition())
            _style_table(table, line)
        block = block.next()


def _heading_format() -> QTextBlockFormat:
    changes = QTextBlockFormat()
    changes.setTopMargin(_HEADING_ABOVE)
    changes.setBottomMargin(_NEAR)
    return changes


def _code_format(block: QTextBlock) -> QTextBlockFormat:
    """Indent a line of code, keep the lines of a block together, and let a long one wrap."""
    changes = QTextBlockFormat()
    changes.setLeftMargin(_CODE_MARGIN)
    changes.setNonBreakableLines(False)
    if not block.previous().blockFormat().hasProperty(_CODE):
        changes.setTopMargin(_NEAR)
    if not block.next().blockFormat().hasProperty(_CODE):
        changes.setBottomMargin(2 * _NEAR)
    return changes


def _style_table(table: QTextTable, line: QColor) -> None:
    changes = table.format()
    changes.setBorderCollapse(True)
    changes.setBorder(1)
    changes.setBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
    changes.setBorderBrush(line)
    changes.setCellPadding(_NEAR)
    changes.setTopMargin(_NEAR)
    changes.setBottomMargin(2 * _NEAR)
    table.setFormat(changes)

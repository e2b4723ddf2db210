"""A browser for local Markdown pages, with pictures, headings as link targets, and a style."""

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

from occ_gui.help.pages import heading_id

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

    def _scroll_to_heading(self, anchor: str) -> None:
        block = self.document().begin()
        while block.isValid():
            if block.blockFormat().headingLevel() and heading_id(block.text()) == anchor:
                self.setTextCursor(QTextCursor(block))
                rect = self.document().documentLayout().blockBoundingRect(block)
                self.verticalScrollBar().setValue(int(rect.top()))
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
_CODE_MARGIN, _HEADING_MARGIN, _SMALL_MARGIN = 14, 16, 4


def style_page(document: QTextDocument, palette: QPalette) -> None:
    """Set the margins of headings, the background of code blocks and the lines of tables."""
    background, line = palette.alternateBase(), palette.mid().color()
    tables: set[int] = set()
    document.pageCount()  # lays out the whole page first; otherwise, Qt skips paragraphs
    block = document.begin()
    while block.isValid():
        cursor = QTextCursor(block)
        if block.blockFormat().headingLevel():
            cursor.mergeBlockFormat(_heading_format())
        elif block.blockFormat().hasProperty(_CODE):
            code = _code_format(block)
            code.setBackground(background)
            cursor.mergeBlockFormat(code)
        elif (table := cursor.currentTable()) is not None and table.firstPosition() not in tables:
            tables.add(table.firstPosition())
            _style_table(table, line)
        block = block.next()


def _heading_format() -> QTextBlockFormat:
    changes = QTextBlockFormat()
    changes.setTopMargin(_HEADING_MARGIN)
    changes.setBottomMargin(_SMALL_MARGIN)
    return changes


def _code_format(block: QTextBlock) -> QTextBlockFormat:
    """Indent a line of code, keep the lines of a block together, and let a long one wrap."""
    changes = QTextBlockFormat()
    changes.setLeftMargin(_CODE_MARGIN)
    changes.setNonBreakableLines(False)
    if not block.previous().blockFormat().hasProperty(_CODE):
        changes.setTopMargin(_SMALL_MARGIN)
    if not block.next().blockFormat().hasProperty(_CODE):
        changes.setBottomMargin(2 * _SMALL_MARGIN)
    return changes


def _style_table(table: QTextTable, line: QColor) -> None:
    changes = table.format()
    changes.setBorderCollapse(True)
    changes.setBorder(1)
    changes.setBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
    changes.setBorderBrush(line)
    changes.setCellPadding(_SMALL_MARGIN)
    changes.setTopMargin(_SMALL_MARGIN)
    changes.setBottomMargin(2 * _SMALL_MARGIN)
    table.setFormat(changes)

"""Margins, code and tables of a page, which Markdown leaves to whoever shows it."""

from PySide6.QtGui import (
    QColor,
    QPalette,
    QTextBlock,
    QTextBlockFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
    QTextFrameFormat,
    QTextTable,
)

_CODE = QTextFormat.Property.BlockCodeFence
_CODE_MARGIN, _HEADING_ABOVE, _NEAR = 14, 16, 4


def style_page(document: QTextDocument, palette: QPalette) -> None:
    """Set the margins of headings, the ground of code blocks and the lines of tables."""
    ground, line = palette.alternateBase(), palette.mid().color()
    tables: set[int] = set()
    document.pageCount()  # lays out all: of a page changed before that Qt leaves out paragraphs
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

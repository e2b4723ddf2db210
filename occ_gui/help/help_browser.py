"""A browser of local Markdown pages, with their pictures and with headings as link targets."""

from PySide6.QtCore import QEvent, Qt, QUrl
from PySide6.QtGui import QImage, QResizeEvent, QTextCursor, QTextDocument
from PySide6.QtWidgets import QTextBrowser

from occ_gui.help.page_style import style_page
from occ_gui.help.pages import heading_id

_MARGIN = 12
_IMAGE = QTextDocument.ResourceType.ImageResource
_UNKNOWN = QTextDocument.ResourceType.UnknownResource


class HelpBrowser(QTextBrowser):
    """Shows Markdown files of this computer; other links open in the system's browser."""

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
        return self._fitted(self._pictures[key])

    def _fitted(self, picture: QImage) -> QImage:
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
            document.addResource(_IMAGE.value, QUrl(name), self._fitted(picture))
        document.markContentsDirty(0, document.characterCount())

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._style()

    def _style(self) -> None:
        style_page(self.document(), self.palette())

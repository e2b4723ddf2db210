"""The window of the manual, which opens at the guide or at the section on the present pane."""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from PySide6.QtCore import QSize, Qt, QUrl
from PySide6.QtGui import QAction, QKeySequence, QTextCursor
from PySide6.QtWidgets import (
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QMainWindow,
    QSplitter,
    QToolBar,
    QVBoxLayout,
    QWidget,
)

from occ_gui.help.help_browser import HelpBrowser
from occ_gui.help.pages import GUIDE, Section, docs_folder, pages, search, sections
from occ_gui.shell.feature import Service
from occ_gui.widgets.building import fill, name_widget

_SIZE = QSize(960, 720)
_LIST_WIDTH = 190
_SEARCH_WIDTH = 240
_PAGE_ROLE = Qt.ItemDataRole.UserRole


class HelpWindow(QMainWindow):
    def __init__(self, folder: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._folder = folder
        tip = "The pages of the manual, or the sections that contain the words."
        self.page_list = name_widget(QListWidget(), "Pages", tip)
        self.page_list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._pages = pages(folder)
        self._sections: list[Section] = []
        tip = "Lists the sections that contain all these words; Enter shows the first."
        self.search_all = _make_search_field("Search all pages", tip)
        self.browser = name_widget(HelpBrowser(), "Page")
        self.search = _make_search_field("Find in this page", "Enter finds the next place.")
        self._lay_out()
        self._show_entries(self._pages)
        self.page_list.itemActivated.connect(self._show_item)
        self.page_list.itemClicked.connect(self._show_item)
        self.browser.sourceChanged.connect(self._show_current_page)
        self.search.textEdited.connect(self._find_from_start)
        self.search.returnPressed.connect(self.find_next)
        self.search_all.textChanged.connect(self._search_all)
        self.search_all.returnPressed.connect(self._show_first)
        self.resize(_SIZE)

    def _lay_out(self) -> None:
        bar = QToolBar("Navigation", movable=False)
        self._add_history(bar)
        bar.addSeparator()
        self.search.setMaximumWidth(_SEARCH_WIDTH)
        bar.addWidget(self.search)
        self.addToolBar(bar)
        self._add_key(QKeySequence.StandardKey.Find, self.search.setFocus)
        self._add_key(QKeySequence("Ctrl+Shift+F"), self.search_all.setFocus)
        self._add_key(QKeySequence.StandardKey.Cancel, self.close)
        left = QWidget()
        fill(QVBoxLayout(left), self.search_all, self.page_list, margins=0)
        parts = QSplitter()
        parts.addWidget(left)
        parts.addWidget(self.browser)
        parts.setStretchFactor(1, 1)
        parts.setSizes([_LIST_WIDTH, _SIZE.width() - _LIST_WIDTH])
        self.setCentralWidget(parts)
        self.browser.setFocus()

    def _add_history(self, bar: QToolBar) -> None:
        keys, browser = QKeySequence.StandardKey, self.browser
        for text, key, go, can_go in (
            ("Back", keys.Back, browser.backward, browser.backwardAvailable),
            ("Forward", keys.Forward, browser.forward, browser.forwardAvailable),
        ):
            action = bar.addAction(text)
            action.setShortcut(QKeySequence(key))
            action.setToolTip(f"{text} ({action.shortcut().toString()})")
            action.setEnabled(False)
            action.triggered.connect(go)
            can_go.connect(action.setEnabled)

    def _add_key(
        self, key: QKeySequence.StandardKey | QKeySequence, do: Callable[[], object]
    ) -> None:
        action = QAction(self, shortcut=QKeySequence(key))
        action.triggered.connect(lambda: do())
        self.addAction(action)

    def show_page(self, page: str) -> None:
        """Show a page, such as ``guide.md``, or one of its headings, ``guide.md#heading``."""
        name, _, heading = page.partition("#")
        url = QUrl.fromLocalFile(str(self._folder / name))
        if heading:
            url.setFragment(heading)
        self.browser.setSource(url)

    def find_next(self) -> bool:
        """Find the next occurrence of the search text; after the last one, start again."""
        text = self.search.text()
        if not text:
            return False
        if self.browser.find(text):
            return True
        self.browser.moveCursor(QTextCursor.MoveOperation.Start)
        return self.browser.find(text)

    def _find_from_start(self) -> None:
        self.browser.moveCursor(QTextCursor.MoveOperation.Start)
        self.find_next()

    def _show_entries(self, entries: Iterable[tuple[str, str]]) -> None:
        self.page_list.clear()
        for title, page in entries:
            item = QListWidgetItem(title, self.page_list)
            item.setToolTip(title)
            item.setData(_PAGE_ROLE, page)

    def _search_all(self, text: str) -> None:
        if not text.strip():
            self._show_entries(self._pages)
            self._show_current_page(self.browser.source())
            return
        if not self._sections:
            self._sections = sections(self._folder)
        entries = [(section.title, section.link) for section in search(self._sections, text)]
        self._show_entries(entries)
        if not entries:
            item = QListWidgetItem("Nothing found", self.page_list)
            item.setFlags(Qt.ItemFlag.NoItemFlags)

    def _show_first(self) -> None:
        item = self.page_list.item(0)
        if item is not None:
            self._show_item(item)

    def _show_item(self, item: QListWidgetItem) -> None:
        page = item.data(_PAGE_ROLE)
        if page is None:
            return
        self.show_page(page)
        words = self.search_all.text().split()
        if words:
            self.browser.find(words[0])

    def _show_current_page(self, url: QUrl) -> None:
        for place in range(self.page_list.count()):
            if self.page_list.item(place).data(_PAGE_ROLE) == url.fileName():
                self.page_list.setCurrentRow(place)
        title = next((title for title, name in self._pages if name == url.fileName()), "")
        if title:
            self.setWindowTitle(f"Manual: {title}")


def _make_search_field(name: str, tip: str) -> QLineEdit:
    return name_widget(QLineEdit(placeholderText=name, clearButtonEnabled=True), name, tip)


class Manual(Service):
    """Opens the window of the manual; ``pages`` maps each pane to a page and a heading."""

    def __init__(
        self, window: QMainWindow, current_pane: Callable[[], str], pages: Mapping[str, str]
    ) -> None:
        super().__init__()
        self._window, self._current_pane, self.pages = window, current_pane, pages
        self._help: HelpWindow | None = None

    def show_pane(self) -> None:
        self.show_page(self.pages.get(self._current_pane(), GUIDE))

    def show_page(self, page: str = GUIDE) -> None:
        """Open the manual at a page or heading, such as ``guide.md#heading``."""
        try:
            if self._help is None:
                self._help = HelpWindow(docs_folder(), self._window)
        except OSError as error:
            self.status_message.emit(f"The manual cannot be read: {error.strerror}.")
            return
        self._help.show()
        self._help.show_page(page)
        self._help.activateWindow()

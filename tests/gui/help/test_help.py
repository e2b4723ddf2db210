"""The manual in its window: pages, links, pictures, search, and the page of each pane."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from gui.kinds import add_widget, show_widget
from gui.pane_bench import PaneBench
from PySide6.QtCore import QObject, QPoint, Qt, QUrl, Slot
from PySide6.QtGui import QColor, QDesktopServices, QPalette, QTextCursor, QTextDocument
from PySide6.QtWidgets import QTextBrowser
from pytestqt.qtbot import QtBot

from occ_gui.app import services
from occ_gui.app.panes import bands, spectrum
from occ_gui.help import help_window
from occ_gui.help.help_browser import HelpBrowser
from occ_gui.help.help_window import HelpWindow
from occ_gui.help.pages import CONTENTS, GUIDE, Section, docs_folder, pages, search, sections
from occ_model.scene.scene import Scene

IMAGE = int(QTextDocument.ResourceType.ImageResource.value)


@pytest.fixture
def manual(qtbot: QtBot) -> HelpWindow:
    window = show_widget(qtbot, HelpWindow(docs_folder()))
    window.show_page(GUIDE)
    return window


class SystemBrowser(QObject):
    """Records the links that the system is asked to open."""

    def __init__(self) -> None:
        super().__init__()
        self.opened: list[str] = []

    @Slot(QUrl)
    def open(self, url: QUrl) -> None:
        self.opened.append(url.toString())


@pytest.fixture
def system() -> Iterator[SystemBrowser]:
    """Receive the links to web pages in place of the system."""
    browser = SystemBrowser()
    QDesktopServices.setUrlHandler("https", browser, "open")  # type: ignore[arg-type]  # it takes text
    yield browser
    QDesktopServices.unsetUrlHandler("https")


def top_heading(browser: QTextBrowser) -> str:
    return browser.cursorForPosition(QPoint(20, 20)).block().text()


def click(qtbot: QtBot, browser: QTextBrowser, text: str, target: str) -> None:
    """Click on the first link of this text to a target."""
    cursor = browser.document().find(text)
    while cursor.charFormat().anchorHref() != target:
        cursor = browser.document().find(text, cursor)
        assert not cursor.isNull(), target
    cursor.setPosition(cursor.position() - len(text) // 2)  # its middle; its end is no part of it
    browser.setTextCursor(cursor)
    browser.ensureCursorVisible()
    place = browser.cursorRect(cursor).center()
    qtbot.mouseClick(browser.viewport(), Qt.MouseButton.LeftButton, pos=place)


def test_a_link_is_followed_to_its_heading_and_undone(manual: HelpWindow, qtbot: QtBot) -> None:
    manual.show_page("guide.md#compare-column-profiles")
    assert top_heading(manual.browser) == "Compare column profiles"
    manual.show_page(GUIDE)
    click(qtbot, manual.browser, "parameters", "parameters.md")
    assert manual.browser.source().fileName() == "parameters.md"
    manual.browser.backward()
    assert manual.browser.source().fileName() == GUIDE
    manual.browser.forward()
    assert manual.browser.source().fileName() == "parameters.md"


def test_a_web_page_is_opened_by_the_system_only(
    qtbot: QtBot, tmp_path: Path, system: SystemBrowser
) -> None:
    web = "https://example.org/x.html"
    (tmp_path / "page.md").write_text(f"Read [the standard]({web}).", encoding="utf-8")
    browser = show_widget(qtbot, HelpBrowser())
    browser.setSource(QUrl.fromLocalFile(str(tmp_path / "page.md")))
    click(qtbot, browser, "standard", web)
    assert system.opened == [web]
    assert browser.source().fileName() == "page.md"


def test_only_files_on_this_computer_are_read(manual: HelpWindow) -> None:
    for url in ("https://example.org/x.png", "http://example.org/x.md", "qrc:/x"):
        for kind in (IMAGE, int(QTextDocument.ResourceType.MarkdownResource.value)):
            assert manual.browser.loadResource(kind, QUrl(url)) is None, url


def picture_width(browser: QTextBrowser) -> float:
    picture = browser.document().resource(IMAGE, QUrl("../pictures/window.png"))
    return float(picture.width() / picture.devicePixelRatio())


def test_a_picture_is_as_wide_as_the_page_and_no_wider(qtbot: QtBot, manual: HelpWindow) -> None:
    for width in (900, 760, 3000):
        manual.resize(width, 700)
        qtbot.wait(1)
        room = manual.browser.viewport().width()
        wanted = min(room, 1280)
        assert wanted - 40 <= picture_width(manual.browser) <= wanted
        # A long page is laid out part by part.
        qtbot.waitUntil(lambda: manual.browser.horizontalScrollBar().maximum() == 0)


def test_a_search_goes_round_the_page_and_stays_where_nothing_is_found(
    qtbot: QtBot, manual: HelpWindow
) -> None:
    qtbot.keyClicks(manual.search, "slider")
    count = manual.browser.toPlainText().lower().count("slider")
    places = []
    for _ in range(2 * count):
        cursor = manual.browser.textCursor()
        assert cursor.selectedText().lower() == "slider"
        places.append(cursor.position())
        qtbot.keyClick(manual.search, Qt.Key.Key_Return)
    assert sorted(set(places)) == places[:count] == places[count:]
    qtbot.keyClicks(manual.search, " of no page")
    assert not manual.find_next()
    manual.browser.moveCursor(QTextCursor.MoveOperation.End)
    place = manual.browser.textCursor().position()
    manual.search.clear()
    manual.browser.moveCursor(QTextCursor.MoveOperation.End)
    assert not manual.find_next()
    assert manual.browser.textCursor().position() == place > 0


def test_keys_begin_a_search_and_close_the_manual(qtbot: QtBot, manual: HelpWindow) -> None:
    manual.activateWindow()
    qtbot.waitUntil(manual.browser.hasFocus)
    qtbot.keyClick(manual.browser, Qt.Key.Key_F, Qt.KeyboardModifier.ControlModifier)
    assert manual.search.hasFocus()
    qtbot.keyClick(manual.search, Qt.Key.Key_Escape)
    assert not manual.isVisible()


def test_code_has_a_background_of_the_theme(manual: HelpWindow) -> None:
    manual.show_page("model.md")
    for colour in ("#112233", "#ddeeff"):
        palette = QPalette(manual.palette())
        palette.setColor(QPalette.ColorRole.AlternateBase, QColor(colour))
        manual.setPalette(palette)
        cursor = manual.browser.document().find("PV_max    =")
        assert cursor.blockFormat().background().color() == QColor(colour)


def test_the_menu_entries_open_the_guide_and_the_page_of_the_pane(
    qtbot: QtBot, small_scene: Scene
) -> None:
    bench, current = PaneBench(qtbot, small_scene), ["spectrum"]
    for declared in (spectrum(), bands(bench.scenes)):
        bench.shell.add(declared, bench.window)
    bench.shell.add(services.manual(bench.window, bench.shell, lambda: current[0]), bench.window)
    entries = bench.window.actions_by_name
    entries["guide"].trigger()
    (browser,) = bench.window.findChildren(HelpBrowser)
    assert browser.window().isVisible()
    assert browser.source().fileName() == GUIDE
    page_of_pane = {
        "spectrum": "guide.md#measure",
        "bands": "limits.md#no-bars-no-flicker",
        "?": GUIDE,
    }
    for pane, page in page_of_pane.items():
        current[0] = pane
        entries["about_pane"].trigger()
        assert browser.source().toString().endswith(f"/{page}")
    assert bench.window.findChildren(HelpBrowser) == [browser]


def test_a_missing_manual_is_answered_with_a_sentence(
    qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(help_window, "docs_folder", lambda: tmp_path)
    bench = PaneBench(qtbot, small_scene)
    bench.add(services.manual(bench.window, bench.shell, lambda: "")).show_page()
    assert bench.said == ["The manual cannot be read: No such file or directory."]
    assert not (tmp_path / CONTENTS).exists()


_PAGE = "# One\nLight.\n## Bars\nDark *stripes*\n```\n# no heading\n```\n## Flicker\nBars of light."


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "index.md").write_text("# Manual\n* [First](one.md): a page\n", encoding="utf-8")
    (tmp_path / "one.md").write_text(_PAGE, encoding="utf-8")
    return tmp_path


def titles(found: list[Section]) -> list[str]:
    return [section.title for section in found]


def test_a_page_is_divided_at_its_headings_and_a_search_ranks_headings_first(
    folder: Path,
) -> None:
    found = sections(folder)
    assert titles(found) == ["First", "First: Bars", "First: Flicker"]
    assert [section.link for section in found] == ["one.md", "one.md#bars", "one.md#flicker"]
    assert "no heading" in found[1].text
    assert titles(search(found, "BARS")) == ["First: Bars", "First: Flicker"]
    assert titles(search(found, "light bars")) == ["First: Flicker"]
    assert titles(search(found, "light unknown")) == []
    assert "Contents: Licences" in titles(sections(docs_folder()))


def test_every_section_of_the_manual_is_found_by_its_heading_and_shown_there(qtbot: QtBot) -> None:
    window = add_widget(qtbot, HelpWindow(docs_folder()))
    every = sections(docs_folder())
    assert len(every) > 80
    for section in every[:: len(every) // 12]:
        window.search_all.setText(section.title.replace(":", " "))
        listed = [window.page_list.item(row) for row in range(window.page_list.count())]
        item = next(item for item in listed if item.text() == section.title)
        window.page_list.itemClicked.emit(item)
        assert window.browser.source().fileName() == section.link.partition("#")[0]
        assert window.windowTitle() == f"Manual: {section.title.partition(':')[0]}"


def test_a_search_without_results_says_so_and_an_empty_one_lists_the_pages(qtbot: QtBot) -> None:
    window = add_widget(qtbot, HelpWindow(docs_folder()))
    window.search_all.setText("xylophone")
    assert window.page_list.count() == 1
    assert window.page_list.item(0).text() == "Nothing found"
    window.search_all.returnPressed.emit()
    assert window.browser.source().isEmpty()
    window.search_all.setText("shutter speed")
    window.search_all.returnPressed.emit()
    assert "shutter" in window.browser.textCursor().selectedText().lower()
    window.search_all.clear()
    listed = [window.page_list.item(row).text() for row in range(window.page_list.count())]
    assert listed == [title for title, _ in pages(docs_folder())]

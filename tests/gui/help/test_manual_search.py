"""Search in all pages: every section is found by its words, and is shown where it begins."""

from pathlib import Path

import pytest
from gui.kinds import add_widget
from pytestqt.qtbot import QtBot

from occ_gui.help.help_window import HelpWindow
from occ_gui.help.pages import Section, docs_folder, pages, search, sections

_PAGE = "# One\nLight.\n## Bars\nDark *stripes*\n```\n# no heading\n```\n## Flicker\nBars of light."


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "index.md").write_text("# Manual\n* [First](one.md): a page\n", encoding="utf-8")
    (tmp_path / "one.md").write_text(_PAGE, encoding="utf-8")
    return tmp_path


def titles(found: list[Section]) -> list[str]:
    return [section.title for section in found]


def test_a_page_is_divided_at_its_headings_and_all_words_are_there_a_heading_counting_more(
    folder: Path,
) -> None:
    found = sections(folder)
    assert titles(found) == ["First", "First: Bars", "First: Flicker"]
    assert [section.link for section in found] == ["one.md", "one.md#bars", "one.md#flicker"]
    assert "no heading" in found[1].text
    assert titles(search(found, "BARS")) == ["First: Bars", "First: Flicker"]
    assert titles(search(found, "light bars")) == ["First: Flicker"]
    assert titles(search(found, "light unknown")) == []


def test_every_section_of_the_manual_is_found_by_its_heading_and_shown_there(qtbot: QtBot) -> None:
    window = add_widget(qtbot, HelpWindow(docs_folder()))
    every = sections(docs_folder())
    assert len(every) > 100
    for section in every[:: len(every) // 12]:
        window.search_all.setText(section.title.replace(":", " "))
        listed = [window.page_list.item(row) for row in range(window.page_list.count())]
        item = next(item for item in listed if item.text() == section.title)
        window.page_list.itemClicked.emit(item)
        assert window.browser.source().fileName() == section.link.partition("#")[0]
        assert window.windowTitle() == f"Manual: {section.title.partition(':')[0]}"


def test_what_is_nowhere_is_said_and_an_empty_search_lists_the_pages_again(qtbot: QtBot) -> None:
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

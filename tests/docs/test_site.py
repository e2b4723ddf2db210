"""The manual as a site: it builds, its links lead somewhere, and its gallery was really run."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest
from documents import FOLDER, PAGES, ROOT, blocks, text_of
from PIL import Image

import occ_model as occ
from occ_model.commands.command_line import make_parser

CONFIGURATION = ROOT / "resources" / "site" / "mkdocs.yml"
EXAMPLES = sorted((ROOT / "resources" / "site" / "gallery").glob("*.py"))

PRINTED = {
    "stripes": r"sent: 718 read: 718",
    "beyond_the_band_model": r"exposure time, 136 µs, is longer than the switching period, 100 µs",
    "which_effects": r"LED rise and fall: about .* levels",
    "light_or_pixel_values": r"largest difference: [1-9]\d*\.\d grey levels",
    "measure_a_camera": r"readout_time: 12\.\d+ µs, standard deviation 0\.\d+ µs",
    "undo_the_exposure": r"threshold: None .*\nequalizer: 718",
    "other_codes": r"manchester: \d+ chips, received 'HELLO'",
}
"""What an example prints when the model is right."""


class Links(HTMLParser):
    """Collects a page's links, what it loads, and the names that links can end in."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.followed: list[str] = []
        self.loaded: list[str] = []
        self.names: set[str] = set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attributes}
        self.names |= {given[name] for name in ("id", "name") if name in given}
        if tag == "a" and "href" in given:
            self.followed.append(given["href"])
        if tag in ("script", "img", "iframe") and "src" in given:
            self.loaded.append(given["src"])
        if tag == "link" and given.get("rel") in ("stylesheet", "icon", "preconnect"):
            self.loaded.append(given["href"])


@cache
def links_of(page: Path) -> Links:
    return Links(page)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the site strictly: a warning is an error."""
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet"]
    built = subprocess.run(
        [*command, "--config-file", CONFIGURATION, "--site-dir", folder],
        check=False,
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
    )
    assert built.returncode == 0, built.stdout + built.stderr
    return folder


def ours(page: Path, site: Path) -> Iterator[tuple[Path, str]]:
    """Give file and name within it of every link of a page to a file of ours."""
    for link in links_of(page).followed:
        parts = urlsplit(link)
        if not parts.scheme and link not in ("#", "."):
            target = page.parent / unquote(parts.path) if parts.path else page
            yield (target / "index.html" if target.is_dir() else target).resolve(), parts.fragment


def html_pages(site: Path) -> list[Path]:
    return [page for page in sorted(site.rglob("*.html")) if page.name != "404.html"]


@pytest.mark.first
@pytest.mark.whole
def test_the_site_leads_everywhere(site: Path) -> None:
    """One test for all that is asked of the site, which is built once for it."""
    check_links(site)
    check_clicks(site)
    check_nothing_is_fetched(site)
    check_gallery(site)
    check_reference(site)


def check_links(site: Path) -> None:
    """Every link leads to a file, and to a name in it."""
    names = {page.resolve(): links_of(page).names for page in html_pages(site)}
    for page in html_pages(site):
        for target, name in ours(page, site):
            assert target.is_file(), (page, target)
            assert not name or unquote(name) in names[target], (page, target, name)


def check_clicks(site: Path) -> None:
    """Two clicks from the first page lead to every other one."""
    first = (site / "index.html").resolve()
    near = {first} | {target for target, _ in ours(first, site)}
    pages = {page.resolve() for page in html_pages(site)}
    reached = near | {target for page in near & pages for target, _ in ours(page, site)}
    assert pages <= reached
    assert len(pages) >= len(PAGES) + len(EXAMPLES)


def check_nothing_is_fetched(site: Path) -> None:
    """No page loads anything from another host."""
    for page in html_pages(site):
        assert [link for link in links_of(page).loaded if urlsplit(link).scheme] == [], page


def check_gallery(site: Path) -> None:
    """Every example has a figure with something on it, a notebook, and the output of its run."""
    assert len(EXAMPLES) >= 8
    for path in EXAMPLES:
        name = re.sub(r"^\d+_", "", path.stem)
        page = (site / "gallery" / f"{name}.html").read_text(encoding="utf-8")
        assert re.search(PRINTED.get(name, ""), unescape(re.sub(r"<[^>]+>", "", page))), name
        figures = sorted((site / "gallery").glob(f"{name}-*.png"))
        assert figures, name
        for figure in figures:
            assert figure.name in page
            grey = np.asarray(Image.open(figure).convert("L"), dtype=float)
            assert min(grey.shape) > 300
            # Something is drawn in most of the picture's height and width.
            drawn = grey < 250
            assert drawn.any(axis=0).mean() > 0.7, figure
            assert drawn.any(axis=1).mean() > 0.7, figure
        notebook = json.loads((site / "gallery" / f"{name}.ipynb").read_text(encoding="utf-8"))
        kinds = {cell["cell_type"] for cell in notebook["cells"]}
        assert kinds == {"markdown", "code"}


def check_reference(site: Path) -> None:
    """The reference has every public name and every command."""
    python = links_of(site / "reference" / "python.html").names
    for name in occ.__all__:
        if not name.startswith("_"):
            assert any(each.endswith(f".{name}") for each in python), name
    commands = links_of(site / "reference" / "command-line.html").names
    assert {f"occ-model-{name}" for name in command_names()} <= commands


def command_names() -> list[str]:
    """Read the commands from the program's own help."""
    found = re.findall(r"^    ([a-z][\w-]*)(?:  |$)", make_parser().format_help(), re.MULTILINE)
    assert len(found) > 12
    return found


def test_the_site_lists_the_pages_of_the_manual() -> None:
    listed = re.findall(r": ([\w-]+\.md)$", text_of(CONFIGURATION), re.MULTILINE)
    assert sorted(listed) == [page.name for page in PAGES]


@pytest.mark.whole
def test_the_code_of_the_tutorial_runs() -> None:
    names: dict[str, object] = {}
    for code in blocks(text_of(FOLDER / "tutorial.md"), "python"):
        exec(compile(code, "tutorial.md", "exec"), names)
    assert "real" in names

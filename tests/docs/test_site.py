"""The manual as a site: it builds, and its gallery was really run."""

import json
import os
import re
import subprocess
import sys
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from documents import FOLDER, PAGES, ROOT, blocks, text_of
from PIL import Image

import occ_model as occ
from occ_model.commands.command_line import commands_of, make_parser

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


@pytest.mark.first
@pytest.mark.whole
def test_the_site_has_its_gallery_and_its_reference(site: Path) -> None:
    """One test for all that is asked of the site, whose build follows the links."""
    check_gallery(site)
    check_reference(site)


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


def names_in(page: Path) -> set[str]:
    """Find the names of a page that links can end in."""
    return set(re.findall(r'\bid="([^"]+)"', page.read_text(encoding="utf-8")))


def check_reference(site: Path) -> None:
    """The reference has every public name and every command."""
    python = names_in(site / "reference" / "python.html")
    for name in vars(occ)["__all__"]:
        if not name.startswith("_"):
            assert any(each.endswith(f".{name}") for each in python), name
    commands = names_in(site / "reference" / "command-line.html")
    assert {f"occ-model-{name}" for name in commands_of(make_parser())} <= commands


def test_the_site_lists_the_pages_of_the_manual() -> None:
    listed = re.findall(r": ([\w-]+\.md)$", text_of(CONFIGURATION), re.MULTILINE)
    assert sorted(listed) == [page.name for page in PAGES]


@pytest.mark.whole
def test_the_code_of_the_guide_runs() -> None:
    names: dict[str, object] = {}
    for code in blocks(text_of(FOLDER / "guide.md"), "python"):
        exec(compile(code, "guide.md", "exec"), names)
    assert "read" in names

"""The scene in an exported figure or table can be read again."""

import os
import struct
import subprocess
import sys
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from photo_files import png_chunk

import occ_model as occ
from occ_model.cli import main
from occ_model.figures.drawing import Drawing
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.provenance import ENDINGS, Provenance, first_scene_in, scene_inside

pytestmark = pytest.mark.usefixtures("plain_figures")

SCENE = occ.load_preset("tablet-122us-real").replace(pattern="10110", start_time=-0.125)
OTHER = occ.load_preset("phone-68us")
# Characters that are special in some of the formats.
PROVENANCE = Provenance(
    "Title (of it) \\ with µs & <b>",
    {"of this file": SCENE, "other": OTHER},
    7,
    ("π)", "(("),
    "2026",
)


def export_file(path: Path, provenance: Provenance = PROVENANCE) -> Path:
    def draw() -> Figure:
        figure = Figure(figsize=(1, 1))
        figure.subplots().plot([1, 2])
        return figure

    Drawing("line", "A line", draw, ("a",), lambda: [(1,)]).write(path, provenance)
    return path


def test_a_provenance_gives_all_its_scenes_back() -> None:
    text = PROVENANCE.text()
    assert first_scene_in(text) == SCENE
    assert first_scene_in(text[text.index("scene other:") :]) == OTHER
    assert "seed 7" in text
    assert "date 2026" in text


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_figure_is_opened_as_a_scene_is(tmp_path: Path, ending: str) -> None:
    path = export_file(tmp_path / f"figure{ending}")
    assert read_scene_file(path) == scene_inside(path) == SCENE
    assert main(["plan", "--scene", str(path)]) == 0


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize(
    "content", [b"", b"\x89PNG\r\n\x1a\n broken", b"\xff\xfe\x00", b"a,b\n1,2"]
)
def test_a_foreign_file_is_refused_in_a_sentence(
    tmp_path: Path, ending: str, content: bytes
) -> None:
    path = tmp_path / f"foreign{ending}"
    path.write_bytes(content)
    with pytest.raises(occ.SceneFileError, match="contains no scene"):
        scene_inside(path)


PNG = b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", struct.pack(">IIBBBBB", 10, 10, 8, 0, 0, 0, 0))
BOMB = zlib.compress(bytes(1_000_000), 9)
SVG, SVG_END = b"<dc:description>", b"</dc:description>"

HOSTILE: dict[str, Callable[[], bytes]] = {
    "many texts.png": lambda: PNG + png_chunk(b"tEXt", b"a\0") * 230_000,
    "many zipped texts.png": lambda: PNG + png_chunk(b"zTXt", b"Description\0\0" + BOMB) * 3000,
    "large zipped text.png": lambda: (
        PNG + png_chunk(b"iTXt", b"Description\0\1\0\0\0" + zlib.compress(bytes(300_000_000), 1))
    ),
    "profiles.png": lambda: PNG + png_chunk(b"iCCP", b"a\0\0" + BOMB) * 3000,
    "starts.svg": lambda: SVG * 190_000,
    "ampersands.svg": lambda: SVG + b"&" * 3_000_000 + SVG_END,
    "long number.svg": lambda: SVG + b"&#" + b"1" * 900_000 + b";" + SVG_END,
    "entities.svg": lambda: SVG + b"&abcdefghijklmnopqrstuvwxyzabcdef" * 30_000 + SVG_END,
    "colons.svg": lambda: SVG + b"scene " + b":" * 900_000 + b"x" + SVG_END,
    "key.svg": lambda: SVG + b"scene a:\nformat = 1\n" + b"a." * 450_000 + b"a = 1" + SVG_END,
    "starts.pdf": lambda: b"/Subject (" * 300_000,
    "escaped starts.pdf": lambda: b"/Subject (\\" * 300_000,
    "no end.pdf": lambda: b"/Subject (" + b"a" * 3_000_000,
    "escapes.pdf": lambda: b"/Subject (" + b"\\(" * 1_500_000 + b")",
    "lines.csv": lambda: b"#\n" * 1_500_000,
    "no comments.csv": lambda: b"\n" * 3_000_000,
    "one line.csv": lambda: b"#" * 3_000_000,
    "key.toml": lambda: b"format = 1\n" + b"a." * 490_000 + b"a = 1",
    "keys.toml": lambda: b"format = 1\n" + b"[a" + b".a" * 30 + b"]\n" * 15_000,
}
"""Contents of hostile files, made only when a test needs them."""

READ = """
import resource, sys
from pathlib import Path
from occ_model.errors import SceneFileError
from occ_model.scene.from_text import read_scene_file
from PIL import PngImagePlugin

used = resource.getrusage(resource.RUSAGE_SELF)
seconds = int(used.ru_utime + used.ru_stime) + 1
resource.setrlimit(resource.RLIMIT_CPU, (seconds + 60, seconds + 60))
held = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (held + 200_000_000,) * 2)
for name in sys.argv[1:]:
    try:
        read_scene_file(Path(name))
    except SceneFileError as error:
        print(error)
"""


@pytest.mark.whole
@pytest.mark.skipif(sys.platform != "linux", reason="only there the limits can be set like this")
def test_no_file_hangs_the_reader_or_fills_the_memory(tmp_path: Path) -> None:
    # Each takes less than a second; the limit of a minute only ends a reader that hangs.
    paths = [tmp_path / name for name in HOSTILE]
    for path in paths:
        path.write_bytes(HOSTILE[path.name]())
    done = subprocess.run(
        [sys.executable, "-c", READ, *paths], capture_output=True, text=True, check=False
    )
    said = done.stdout.splitlines()
    assert (done.returncode, done.stderr, len(said)) == (0, "", len(paths)), said[-1:]
    for path, line in zip(paths, said, strict=True):
        assert line.startswith(str(path))
        assert len(line) < len(str(path)) + 300


def test_only_the_start_of_a_large_picture_or_table_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read, given = os.read, []

    def read_and_count(descriptor: int, count: int) -> bytes:
        content = read(descriptor, count)
        given.append(len(content))
        return content

    for ending in (".png", ".csv"):
        path = export_file(tmp_path / f"figure{ending}")
        os.truncate(path, 10**11)  # a hole, which takes no space on the disk
        with monkeypatch.context() as patch:
            patch.setattr(os, "read", read_and_count)
            assert scene_inside(path) == SCENE
    assert sum(given) <= 2_000_000
    for ending in (".svg", ".pdf"):
        path = export_file(tmp_path / f"figure{ending}")
        os.truncate(path, 10**11)
        with pytest.raises(occ.SceneFileError, match="more than 64,000,000 bytes"):
            scene_inside(path)


def test_the_first_of_many_scenes_is_read_and_no_other(tmp_path: Path) -> None:
    path = tmp_path / "many.csv"
    scene = "".join(f"# {line}\n" for line in SCENE.to_toml().splitlines())
    path.write_text(f"# scene a:\n{scene}" + "# scene b:\n# no scene\n" * 10_000)
    assert scene_inside(path) == SCENE


def test_a_scene_of_a_newer_version_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "figure.csv"
    text = "\n".join(f"# {line}" for line in PROVENANCE.lines())
    path.write_text(text.replace("format = 1", "format = 99"), encoding="utf-8")
    with pytest.raises(occ.SceneFileError, match="format 99"):
        scene_inside(path)

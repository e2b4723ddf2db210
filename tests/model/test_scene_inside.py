"""Exported figures and tables give their scenes back."""

from pathlib import Path

import pytest
from matplotlib.figure import Figure

import occ_model as occ
from occ_model.cli import main
from occ_model.export.drawing import FORMATS, house_style, write_figure
from occ_model.export.tables import write_table
from occ_model.provenance import Provenance, scenes_in
from occ_model.scene import Scene
from occ_model.scene_inside import ENDINGS, scene_inside
from occ_model.settings import read_scene_file

SCENE = occ.load_preset("tablet-122us-real").replace(pattern="10110", start_time=-0.125)
OTHER = occ.load_preset("phone-68us")
# All that a format might stumble over.
PROVENANCE = Provenance(
    "Title (of it) \\ with µs & <b>", {"at hand": SCENE, "other": OTHER}, 7, ("π)", "(("), "2026"
)


def exported(path: Path, provenance: Provenance = PROVENANCE) -> Path:
    if path.suffix == ".csv":
        write_table(path, ("a",), [(1,)], provenance)
        return path
    figure = Figure(figsize=(1, 1))
    figure.subplots().plot([1, 2])
    with house_style():
        write_figure(path, figure, provenance)
    return path


def test_a_provenance_gives_all_its_scenes_back() -> None:
    assert scenes_in(PROVENANCE.text()) == {"at hand": SCENE, "other": OTHER}
    assert "seed 7" in PROVENANCE.text()
    assert "date 2026" in PROVENANCE.text()


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_file_gives_its_scene_back(tmp_path: Path, ending: str) -> None:
    assert scene_inside(exported(tmp_path / f"figure{ending}")) == SCENE


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_figure_is_opened_as_a_scene_is(tmp_path: Path, ending: str) -> None:
    path = exported(tmp_path / f"figure{ending}")
    assert read_scene_file(path) == SCENE
    assert main(["plan", "--scene", str(path)]) == 0


def test_every_format_of_figures_and_tables_is_read() -> None:
    assert set(ENDINGS) == {f".{name}" for name in FORMATS} | {".csv"}


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize(
    "content", [b"", b"\x89PNG\r\n\x1a\n broken", b"\xff\xfe\x00", b"a,b\n1,2"]
)
def test_a_foreign_file_is_refused_in_a_sentence(
    tmp_path: Path, ending: str, content: bytes
) -> None:
    path = tmp_path / f"foreign{ending}"
    path.write_bytes(content)
    with pytest.raises(occ.SceneFileError, match="carries no scene"):
        scene_inside(path)


def test_a_truncated_figure_is_refused_in_a_sentence(tmp_path: Path) -> None:
    for ending in ENDINGS:
        path = exported(tmp_path / f"figure{ending}")
        whole = path.read_bytes()
        for share in (0.1, 0.5, 0.9):
            path.write_bytes(whole[: int(share * len(whole))])
            try:
                scene = scene_inside(path)
            except occ.OccError:
                continue
            assert isinstance(scene, Scene)


def test_a_missing_file_is_refused_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(occ.SceneFileError, match="cannot be read: No such file"):
        scene_inside(tmp_path / "missing.png")


def test_a_scene_of_a_newer_version_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "figure.csv"
    text = "\n".join(f"# {line}" for line in PROVENANCE.lines())
    path.write_text(text.replace("format = 1", "format = 99"), encoding="utf-8")
    with pytest.raises(occ.SceneFileError, match="format 99"):
        scene_inside(path)

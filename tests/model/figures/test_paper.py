"""The paper's figures as files."""

import csv
import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from amount import amount
from PIL import Image

import occ_model as occ
from occ_model.cli import main
from occ_model.figures import drawing, paper
from occ_model.scene.scene import Scene
from occ_model.study import paper_grid


@pytest.fixture(scope="module", autouse=True)
def fewer_points() -> Iterator[None]:
    """Measure and draw the rates of 12 of the 80 points of the paper's grid."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (paper, paper_grid):
            patch.setattr(module, "FREQUENCIES", paper_grid.FREQUENCIES[::3])
            patch.setattr(module, "DISTANCES", paper_grid.DISTANCES[::3])
        yield


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All figures, from one image a point."""
    out = tmp_path_factory.mktemp("figures") / "deep" / "folder"
    written = drawing._fitted_bytes
    with pytest.MonkeyPatch.context() as patch:
        if not amount(0, 1):  # every day without PDFs
            patch.setattr(
                drawing, "_fitted_bytes", lambda *each: b"" if each[1] == "pdf" else written(*each)
            )
        patch.setitem(drawing._STYLE, "figure.dpi", amount(30, 200))
        assert main(["figures", "--out", str(out), "--images", "1", "--seed", "3"]) == 0
    return out


def comments(path: Path) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    return "\n".join(line[2:] for line in lines if line.startswith("#"))


def rows(path: Path) -> list[dict[str, str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@pytest.mark.parametrize("number", range(2, 7))
def test_figures_carry_their_scene_and_version(folder: Path, number: int) -> None:
    with Image.open(folder / f"figure-{number}.png") as picture:
        inside = str(picture.info["Description"])
    assert comments(folder / f"figure-{number}.csv") == inside
    assert f"occ_model {occ.__version__}" in inside
    text = inside[inside.index("format = ") :].split("\n\nscene ")[0]
    assert isinstance(Scene.from_toml(text), Scene)


def test_rates_carry_their_seed_and_stand_in_the_table(folder: Path) -> None:
    assert "seed 3" in comments(folder / "figure-5.csv").splitlines()
    table = rows(folder / "figure-5.csv")
    assert len(table) == 2 * 2 * len(paper_grid.FREQUENCIES) * len(paper_grid.DISTANCES)
    one = table[len(table) // 3]
    scene = occ.load_preset(one["preset"]).replace(
        switching_frequency=float(one["switching frequency (Hz)"]),
        distance=float(one["distance (m)"]),
    )
    again = occ.success_rate(scene, 1, one["decoder"], int(one["seed"]))
    assert again == float(one["success rate (%)"])


def test_figure_3_has_the_band_model_and_figure_4_has_not(folder: Path) -> None:
    assert "band model (grey level)" in rows(folder / "figure-3.csv")[0]
    assert "band model (grey level)" not in rows(folder / "figure-4.csv")[0]


def test_figure_4_holds_the_simulated_profile(folder: Path) -> None:
    profile = occ.column_profile(occ.load_preset("phone-136us"))
    for row in rows(folder / "figure-4.csv"):
        assert float(row["simulation (grey level)"]) == profile[int(float(row["column"]))]


def test_a_photo_is_drawn_beside_the_simulation(tmp_path: Path) -> None:
    photo = tmp_path / "photo.png"
    Image.fromarray(occ.render(Scene().replace(rows=20)).image).save(photo)
    paper.write_profile_figure(tmp_path, 3, "phone-68us", occ.load_photo(photo))
    assert "photo (grey level)" in rows(tmp_path / "figure-3.csv")[0]
    assert "photo.png" in comments(tmp_path / "figure-3.csv")


def test_figure_2_holds_the_calculated_values_and_the_mask(folder: Path) -> None:
    frame = occ.render(occ.load_preset("phone-68us"), tolerance=math.inf)
    table = rows(folder / "figure-2.csv")
    values = [float(row["calculated value (grey level)"]) for row in table]
    assert values == frame.signal.tolist()
    covered = [int(row["rows of the mask"]) > 0 for row in table]
    left, right = frame.corners[:, 0].min(), frame.corners[:, 0].max()
    assert covered == [left <= column <= right for column in range(len(table))]
    assert "corners: column 862.24" in comments(folder / "figure-2.csv")

"""The paper's figures as files."""

import csv
import math
from pathlib import Path

import pytest
from amount import amount
from PIL import Image

import occ_model as occ
from occ_model.cli import main
from occ_model.figures import drawing, paper
from occ_model.scene.scene import Scene
from occ_model.study import paper_grid


def write_all_figures(folder: Path, patch: pytest.MonkeyPatch) -> None:
    """Write all figures, with rates of 4 of the 80 points, from one image each."""
    for module in (paper, paper_grid):
        patch.setattr(module, "FREQUENCIES", paper_grid.FREQUENCIES[::5])
        patch.setattr(module, "DISTANCES", paper_grid.DISTANCES[::5])
    written = drawing.encode_figure
    if not amount(0, 1):  # without PDFs unless --whole
        patch.setattr(
            drawing, "encode_figure", lambda *each: b"" if each[1] == "pdf" else written(*each)
        )
    assert main(["figures", "--out", str(folder), "--images", "1", "--seed", "3"]) == 0


def comments(path: Path) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    return "\n".join(line[2:] for line in lines if line.startswith("#"))


def rows(path: Path) -> list[dict[str, str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@pytest.mark.usefixtures("plain_figures")
def test_the_figures_carry_their_scene_and_the_numbers_that_are_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A single test, since writing the figures takes most of its time."""
    folder = tmp_path / "deep" / "folder"
    write_all_figures(folder, monkeypatch)
    for number in range(2, 7):
        assert_scene_and_version_are_inside(folder, number)
    assert_process_is_that_of_the_mask(folder)
    assert "band model (grey level)" in rows(folder / "figure-3.csv")[0]
    assert "band model (grey level)" not in rows(folder / "figure-4.csv")[0]
    profile = occ.column_profile(occ.load_preset("phone-136us"))
    for row in rows(folder / "figure-4.csv"):
        assert float(row["simulation (grey level)"]) == profile[int(float(row["column"]))]
    assert_rates_can_be_had_again(folder)


def assert_scene_and_version_are_inside(folder: Path, number: int) -> None:
    with Image.open(folder / f"figure-{number}.png") as picture:
        inside = str(picture.info["Description"])
    assert comments(folder / f"figure-{number}.csv") == inside
    assert f"occ_model {occ.__version__}" in inside
    text = inside[inside.index("format = ") :].split("\n\nscene ")[0]
    assert isinstance(Scene.from_toml(text), Scene)


def assert_process_is_that_of_the_mask(folder: Path) -> None:
    frame = occ.render(occ.load_preset("phone-68us"), tolerance=math.inf)
    table = rows(folder / "figure-2.csv")
    values = [float(row["calculated value (grey level)"]) for row in table]
    assert values == frame.signal.tolist()
    covered = [int(row["rows of the mask"]) > 0 for row in table]
    left, right = frame.corners[:, 0].min(), frame.corners[:, 0].max()
    assert covered == [left <= column <= right for column in range(len(table))]
    assert "corners: column 862.24" in comments(folder / "figure-2.csv")


def assert_rates_can_be_had_again(folder: Path) -> None:
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


@pytest.mark.usefixtures("plain_figures")
def test_a_photo_is_drawn_beside_the_simulation(tmp_path: Path) -> None:
    photo = tmp_path / "photo.png"
    Image.fromarray(occ.render(Scene().replace(rows=20)).image).save(photo)
    paper.write_profile_figure(tmp_path, 3, "phone-68us", occ.load_photo(photo))
    assert "photo (grey level)" in rows(tmp_path / "figure-3.csv")[0]
    assert "photo.png" in comments(tmp_path / "figure-3.csv")

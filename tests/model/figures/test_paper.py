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
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study import paper_grid
from occ_model.study.success_rate import right_and_whole
from occ_model.study.sweep import points


@pytest.fixture(scope="module", autouse=True)
def fewer_points() -> Iterator[None]:
    """Measure and draw the rates of 12 of the 80 points of the paper's grid."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (paper, paper_grid):
            patch.setattr(module, "FREQUENCIES", paper_grid.FREQUENCIES[::3])
            patch.setattr(module, "DISTANCES", paper_grid.DISTANCES[::3])
        yield


@pytest.fixture
def only_rates(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out the figures that show no rates: those of the folder are looked at."""
    monkeypatch.setattr(paper, "write_process_figure", lambda *_: None)
    monkeypatch.setattr(paper, "write_profile_figure", lambda *_: None)


Counted = tuple[tuple[int, ...], tuple[int, ...]]


_COUNTED: dict[tuple[Scene, str], Counted] = {}


def counted_once(scene: Scene, settings: RateSettings) -> Counted:
    """Count right bits, or recall them: those of a scene and its seed are always the same."""
    asked = scene, repr(settings)
    if asked not in _COUNTED:
        _COUNTED[asked] = right_and_whole(scene, settings)
    return _COUNTED[asked]


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
        patch.setattr(
            points, "right_and_whole", lambda scene, settings, _: counted_once(scene, settings)
        )
        patch.setitem(drawing._STYLE, "savefig.dpi", amount(30, 200))
        assert main(["figures", "--out", str(out), "--images", "1", "--seed", "3"]) == 0
    return out


def comments(path: Path) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    return "\n".join(line[2:] for line in lines if line.startswith("#"))


def rows(path: Path) -> list[dict[str, str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@pytest.mark.whole
def test_every_figure_comes_as_pdf_png_and_csv(folder: Path) -> None:
    expected = {f"figure-{n}.{end}" for n in range(2, 7) for end in ("pdf", "png", "csv")}
    assert {path.name for path in folder.iterdir()} == expected
    for path in folder.glob("*.pdf"):
        assert path.read_bytes().startswith(b"%PDF")


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


@pytest.mark.whole
@pytest.mark.usefixtures("only_rates")
def test_figures_that_were_interrupted_go_on_with_the_rates_kept(
    tmp_path: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command = ["figures", "--out", str(tmp_path), "--images", "1", "--seed", "3"]
    measured: list[float] = []

    def measured_by_hand(scene: Scene, settings: RateSettings, pulse: object) -> Counted:
        if len(measured) == 10:
            raise KeyboardInterrupt
        measured.append(scene.pose.distance)
        return counted_once(scene, settings)

    with monkeypatch.context() as patch:
        patch.setattr(points, "right_and_whole", measured_by_hand)
        assert main(command) == 130
    (kept,) = tmp_path.glob("rates-*.csv")
    assert len(rows(kept)) == 10 * 2
    again: list[float] = []

    def counted(scene: Scene, settings: RateSettings, pulse: object) -> Counted:
        again.append(scene.pose.distance)
        return counted_once(scene, settings)

    monkeypatch.setattr(points, "right_and_whole", counted)
    assert main(command) == 0
    assert len(again) == 4 * len(paper_grid.FREQUENCIES) * len(paper_grid.DISTANCES) - 10
    written = {path.name for path in folder.iterdir() if path.stem in ("figure-5", "figure-6")}
    assert {path.name for path in tmp_path.iterdir()} == written
    table = "figure-5.csv"
    assert (tmp_path / table).read_bytes() == (folder / table).read_bytes()

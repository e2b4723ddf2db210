"""Files of what the window shows."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from amount import amount
from matplotlib.figure import Figure

import occ_model as occ
from occ_model.figures.caption import caption
from occ_model.figures.decoding import decode_drawing
from occ_model.figures.drawing import Drawing, house_style, write_all
from occ_model.figures.page import fit_texts
from occ_model.figures.window_panes import picture_drawing, profile_drawing
from occ_model.scene.provenance import ENDINGS, Provenance, scene_inside
from occ_model.study.cause.cause import cause_of

SCENE = occ.load_preset("phone-68us").replace(rows=60, panel_height=2.0)
FRAME = occ.render(SCENE)
READ, MATCHED = occ.decode(FRAME.image, SCENE), occ.decode(FRAME.image, SCENE, "matched")
BAND = occ.band_profile(SCENE)
PHOTO = replace(  # of uneven light, and with a residual
    occ.compare(np.sqrt(FRAME.profile[800:2000]) + 3.0, FRAME.profile, 800.0),
    height=np.linspace(0.5, 1.5, 1188),
)


def drawings() -> list[Drawing]:
    return [
        picture_drawing(FRAME, READ.region, FRAME.image),
        profile_drawing(FRAME, BAND, comparison=PHOTO),
        decode_drawing(SCENE, READ),
        decode_drawing(SCENE, MATCHED),
    ]


def provenance(drawing: Drawing) -> Provenance:
    return Provenance(drawing.title, {"of this file": SCENE}, 1, date="2026-11-21")


def rows(path: Path) -> list[dict[str, str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the table of each drawing."""
    folder = tmp_path_factory.mktemp("report")
    for drawing in drawings():
        drawing.write(folder / f"{drawing.name}.csv", provenance(drawing))
    return folder


def test_the_scene_can_be_read_from_every_table(folder: Path) -> None:
    assert all(scene_inside(path) == SCENE for path in folder.iterdir())


def test_the_tables_have_the_numbers_that_are_drawn(folder: Path) -> None:
    profile = rows(folder / "profile.csv")
    assert [float(row["simulation (grey level)"]) for row in profile] == FRAME.profile.tolist()
    assert [float(row["band model (grey level)"]) for row in profile] == BAND.tolist()
    photo = np.array([float(row["photo, fitted levels (grey level)"]) for row in profile])
    begin, end = PHOTO.first_column, PHOTO.first_column + len(PHOTO.photo)
    assert np.isnan(photo[:begin]).all()
    assert np.array_equal(photo[begin:end], PHOTO.photo)
    assert np.isnan(photo[end:]).all()
    residual = np.array([float(list(row.values())[-1]) for row in profile])
    assert np.sqrt(np.nanmean(residual**2)) == pytest.approx(PHOTO.rmse)  # as the figure says
    _, below = profile_drawing(FRAME, BAND, comparison=PHOTO).draw().axes
    assert f"RMSE {PHOTO.rmse:.2f} levels" in below.get_title()
    assert np.array_equal(below.lines[-1].get_ydata(), residual, equal_nan=True)
    signal = READ.signal
    read = [row["signal (grey level)"] for row in rows(folder / "decoding-threshold.csv")]
    assert [float(value) for value in read if value] == signal.tolist()
    region = READ.region
    for row in rows(folder / "decoding-threshold.csv"):
        for name in ("column", "chip from column"):
            within, whole = row[f"{name} of the region"], row[f"{name} of the picture"]
            assert (within == "") == (whole == "")
            assert not within or float(whole) - float(within) == region.first_column
    first = rows(folder / "picture.csv")[0]
    assert len(first) == 1 + FRAME.image.shape[1] // 4


def test_a_file_is_the_same_alone_and_among_others(tmp_path: Path) -> None:
    drawing = Drawing("line", "A line", lambda: Figure((2.0, 1.0)), ("a",), lambda: [(1,)])
    folder = tmp_path / "deep" / "folder"
    written = write_all(folder, [drawing, *drawings()[: amount(0, 4)]], provenance)
    assert sorted(written) == sorted(folder.iterdir())
    for path in written[: len(ENDINGS)]:
        alone = tmp_path / f"alone{path.suffix}"
        drawing.write(alone, provenance(drawing))
        assert alone.read_bytes() == path.read_bytes()
        assert scene_inside(path) == SCENE


def test_files_of_which_one_cannot_be_replaced_are_refused_before_any_is_drawn(
    tmp_path: Path,
) -> None:
    (tmp_path / "line.csv").mkdir()
    drawing = Drawing("line", "A line", lambda: pytest.fail("was drawn"), ("a",), lambda: [(1,)])
    with pytest.raises(occ.OutputError, match=r"line\.csv is a folder; name a file"):
        write_all(tmp_path, [drawing], provenance)
    assert [path.name for path in tmp_path.iterdir()] == ["line.csv"]


def test_a_failed_decoding_is_drawn_up_to_its_failure() -> None:
    dark = SCENE.replace(luminance=0.0)
    result = occ.decode(occ.render(dark).image, dark)
    assert result.failure is not None
    drawing = decode_drawing(dark, result)
    assert result.failure in drawing.title
    with house_style():
        assert drawing.draw().axes


@pytest.mark.parametrize("enhanced", [False, True])
def test_a_profile_has_the_threshold_of_its_decoder(enhanced: bool) -> None:
    found = READ
    with house_style():
        figure = profile_drawing(FRAME, None, decoded=found, enhanced=enhanced).draw()
    (line,) = [item for item in figure.axes[0].lines if item.get_label() == "threshold"]
    (level,) = set(np.asarray(line.get_ydata(), dtype=float).tolist())
    profile = FRAME.signal if enhanced else FRAME.profile
    inside = profile[found.region.first_column : found.region.last_column]
    # It separates the drawn columns as the decoder separates those that it reads.
    ones = (found.signal > found.threshold) == (inside > level)
    assert np.mean(ones) > 0.95
    assert "threshold" in [text.get_text() for text in figure.legends[0].get_texts()]


def test_a_profile_has_no_threshold_of_a_decoder_without_one() -> None:
    for decoded in (None, MATCHED):
        with house_style():
            figure = profile_drawing(FRAME, None, decoded=decoded).draw()
        assert "threshold" not in [line.get_label() for line in figure.axes[0].lines]


def test_an_unknown_ending_is_refused_before_any_writing(tmp_path: Path) -> None:
    drawing = drawings()[0]
    with pytest.raises(occ.OutputError, match=r"figure\.doc does not have the ending"):
        drawing.write(tmp_path / "figure.doc", provenance(drawing))
    assert not list(tmp_path.iterdir())


def test_a_decoding_figure_names_the_cause_first_and_its_title_lies_above_the_legend() -> None:
    scene = occ.load_preset("phone-136us").replace(rows=200, iso=12800.0)
    read = occ.decode(occ.render(scene).image, scene)
    drawing = decode_drawing(scene, read, cause_of(scene, "threshold"))
    assert ", Overexposed: the first two headers are " in drawing.title
    assert "misread" not in drawing.title
    with house_style():
        figure = drawing.draw()
        fit_texts(figure)
    axes = figure.axes[0]
    title = next(text for text in axes.get_children() if "Overexposed" in str(text))
    assert not title.get_window_extent().overlaps(axes.get_legend().get_window_extent())


@pytest.mark.parametrize(
    ("sent", "words"),
    [
        ({}, "switching frequency 10 kHz"),
        ({"light": "lamp", "lamp_frequency": 239.0, "duty": 0.3}, "lamp of 239 Hz, duty 30 %"),
        ({"light": "mains"}, "lamp on the mains of 50 Hz, depth 30 %"),
        ({"pattern": "10"}, "lamp of 5 kHz, duty 50 %"),
    ],
)
def test_a_caption_names_what_the_light_does(sent: dict[str, str | float], words: str) -> None:
    assert caption(SCENE.replace(**sent)) == (
        f"exposure time 68 µs, {words}, readout time 8 µs, distance 1.2 m"
    )

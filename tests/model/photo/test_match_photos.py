"""Many photos of one scene: a row each, and one answer that only sure ones make."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matches import match_with
from PIL import Image
from simulated_photos import photo_of
from worker_calls import PickledJobs

import occ_model as occ
from occ_model.parallel import process_pool
from occ_model.photo.many import match_photos as module
from occ_model.photo.many.other_programs import frame_readout_time, lines_to_paste
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.many.table import table_of
from occ_model.results.photo_table import PhotoRow, PhotoTable, csv_text
from occ_model.scene.scene import Scene

SCENE = occ.load_preset("phone-68us").replace(
    rows=60,
    columns=700,
    pattern="10",
    switching_frequency=5e3,
    readout_time=9e-6,
    exposure_time=120e-6,
    panel_width=3.0,
    pixel_pitch=4e-6,  # with few electrons, noise darkens the mean of dark columns
    enhancement="none",
    averaging="light",
)


def picture_of(scene: Scene, seed: int) -> np.ndarray:
    start = float(np.random.default_rng(seed).uniform(0.0, 4e-4))
    return occ.render(scene.replace(start_time=start), tolerance=0.0, seed=seed).image


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("photos")
    for seed in range(2):
        Image.fromarray(picture_of(SCENE, seed)).save(folder / f"{seed}.png")
    (folder / "damaged.jpg").write_bytes(b"\xff\xd8\xff nothing")
    Image.new("L", (300, 200), 128).save(folder / "flat.png")
    return folder


@pytest.fixture(scope="module")
def table(folder: Path) -> PhotoTable:
    return occ.match_photos(sorted(folder.iterdir()), SCENE, sent="scene")


def row(
    value: float,
    error: float = 1e-9,
    verdict: str = "sure",
    exposure: float = 80e-6,
    is_exposure_doubtful: bool = False,
    **more: object,
) -> PhotoRow:
    made = PhotoRow(
        Path("x.png"),
        verdict,
        match=match_with(
            readout_time=value,
            exposure_time=exposure,
            uncertainties={"readout_time": error, "exposure_time": 1e-6},
            exposure_reasons=("Few edges.",) if is_exposure_doubtful else (),
        ),
        lines=1000,
        size=(600, 1000),
        scanned_along="lines",
    )
    return replace(made, **more)  # type: ignore[arg-type]


def made(*rows: PhotoRow, estimate: str = "readout_time") -> PhotoTable:
    return table_of(MatchSettings(SCENE, estimate), rows)


def test_every_photo_has_a_row_in_the_order_given(table: PhotoTable, folder: Path) -> None:
    assert [one.path for one in table.rows] == sorted(folder.iterdir())
    verdicts = {one.path.name: one.verdict for one in table.rows}
    assert verdicts.pop("damaged.jpg") == "unreadable"
    assert verdicts.pop("flat.png") == "refused"
    assert set(verdicts.values()) == {"sure"}
    assert all(bool(one.note) == (one.verdict != "sure") for one in table.rows)


def test_the_mean_is_the_truth_within_its_error(table: PhotoTable) -> None:
    assert table.estimated.count == 2
    assert abs(table.estimated.value - 9e-6) < 4.0 * table.estimated.uncertainty
    assert abs(table.exposure_time.value - 120e-6) < 4.0 * table.exposure_time.uncertainty


def test_processes_give_the_same_table(
    table: PhotoTable, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(process_pool, "ProcessPool", PickledJobs)
    reports: list[tuple[int, int]] = []
    parallel = occ.match_photos(
        sorted(folder.iterdir()),
        SCENE,
        sent="scene",
        jobs=2,
        progress=lambda *report: reports.append(report),
    )
    assert parallel.rows == table.rows
    assert csv_text(parallel) == csv_text(table)
    assert parallel.estimated == table.estimated
    assert reports[0] == (0, 4)
    assert reports[-1] == (4, 4)


def test_doubtful_photos_never_change_the_mean() -> None:
    sure = made(row(1e-5), row(1.0001e-5))
    mixed = made(
        row(1e-5), row(3e-5, 1e-15, "doubtful"), row(1.0001e-5), row(9e-6, 1e-12, "doubtful")
    )
    assert (mixed.estimated, mixed.exposure_time) == (sure.estimated, sure.exposure_time)
    assert [mixed.is_counted(place) for place in range(4)] == [True, False, True, False]


def test_a_doubtful_exposure_changes_only_the_mean_of_the_readout_time() -> None:
    apart = row(1.0002e-5, exposure=9e-5, is_exposure_doubtful=True)
    table, readouts = made(row(1e-5), row(1.0001e-5), apart), made(row(1e-5), row(1.0001e-5))
    assert table.estimated.count == 3
    assert table.exposure_time == readouts.exposure_time
    lines = [line for line in csv_text(table).splitlines() if line[0] != "#"]
    said = [one["exposure time is"] for one in csv.DictReader(lines)]
    assert said == ["sure", "sure", "doubtful"]


def test_outliers_are_marked_by_their_place_in_the_table() -> None:
    rows = [row(1e-5 + k * 1e-10) for k in range(5)]
    table = made(row(2e-5, verdict="doubtful"), *rows[:3], row(1.5e-5), *rows[3:])
    assert table.estimated.outliers == (4,)
    assert [place for place in range(7) if table.is_outlier(place)] == [4]
    assert table.estimated.count == 5


def test_no_sure_photo_gives_no_mean_and_says_so() -> None:
    table = made(row(1e-5, verdict="doubtful"))
    assert (table.estimated, table.exposure_time) == (None, None)
    assert table.notes == ("No photo is sure: there is no mean of the readout time.",)
    assert lines_to_paste(table) == {}


def test_exposures_that_were_set_differently_have_no_mean() -> None:
    table = made(row(1e-5, noted_exposure=1e-4), row(1e-5, noted_exposure=2e-4))
    assert table.exposure_time is None
    assert table.notes == (
        "The camera noted exposure times from 100 µs to 200 µs: they have no mean.",
    )


def test_photos_in_portrait_and_landscape_are_of_one_size() -> None:
    table = made(row(1e-5), row(1e-5, size=(1000, 600), scanned_along="columns"))
    assert table.notes == ()


def test_photos_of_different_sizes_are_named() -> None:
    table = made(row(1e-5), row(1e-5), row(1e-5, size=(300, 500), lines=500))
    assert table.notes == (
        "The photos in the mean are of different sizes, 600 x 1000 (2), 300 x 500 (1): their "
        "readout time need not be the same.",
    )
    assert frame_readout_time(table) is None


def test_readout_of_the_frame_is_that_of_all_lines() -> None:
    table = made(row(7.0e-6, 1e-9), row(7.0e-6, 1e-9))
    assert frame_readout_time(table) == pytest.approx((7e-3, 1e-6))
    assert lines_to_paste(table) == {
        "OpenDroneMap": "--rolling-shutter --rolling-shutter-readout 7.0000",
        "Gyroflow": '"frame_readout_time": 7.0000, "frame_readout_direction": "TopToBottom"',
    }


MEASURED = match_with(switching_frequency=5e3, uncertainties={"switching_frequency": 1.0})


@pytest.mark.parametrize(
    ("rows", "estimate", "programs"),
    [
        ([row(7e-6), row(9e-6)], "readout_time", []),
        # They differ by less than matters.
        ([row(7e-6, 1e-12), row(7.0001e-6, 1e-12)], "readout_time", ["Gyroflow", "OpenDroneMap"]),
        # In portrait and landscape: of no one direction.
        (
            [row(1e-5), row(1e-5, size=(1000, 600), scanned_along="columns")],
            "readout_time",
            ["OpenDroneMap"],
        ),
        ([row(1e-5, match=MEASURED)], "switching_frequency", []),
    ],
)
def test_only_one_readout_time_gives_lines_to_paste(
    rows: list[PhotoRow], estimate: str, programs: list[str]
) -> None:
    table = made(*rows, estimate=estimate)
    assert sorted(lines_to_paste(table)) == programs
    differ = any("differ by more than their errors" in note for note in table.notes)
    assert differ == (not table.estimated.agrees)


def test_the_file_holds_every_row_and_the_scene(table: PhotoTable) -> None:
    text = csv_text(table, ["more"])
    comments = [line[2:] for line in text.splitlines() if line.startswith("#")]
    assert "Match of 4 photos: 2 sure, 1 unreadable, 1 refused" in comments
    assert "more" in comments
    assert (
        occ.Scene.from_toml("\n".join(comments[comments.index("scene of this file:") + 1 :]))
        == SCENE
    )
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert [one["file"] for one in rows] == [str(one.path) for one in table.rows]
    assert [one["in the mean"] for one in rows] == ["yes"] * 2 + ["no"] * 2
    assert float(rows[0]["readout time (s)"]) == table.rows[0].readout_time


def test_the_file_names_what_is_only_assumed_beside_each_number_that_rests_on_it() -> None:
    table = made(row(7e-6, 1.234567e-9), row(7.0005e-6, 1.3e-9), PhotoRow(Path("x"), "refused"))
    for condition, rests_on in (("if f = 2 kHz: ", "if f = 2 kHz"), ("", "given")):
        text = csv_text(table, condition=condition)
        for name in ("readout_time", "exposure_time"):
            assert f"# mean of {name}: {condition}" in text
        rows = list(csv.DictReader(line for line in text.splitlines() if line[0] != "#"))
        assert all(one["rests on"].endswith(rests_on) for one in rows[:2])
        assert rows[2]["rests on"] == ""
        assert rows[0]["its error (s)"] in text
        assert "1.2e-09" in text
        assert "1.234" not in text


def test_the_mean_of_one_photo_is_tested_against_nothing() -> None:
    text = csv_text(made(row(7e-6)))
    assert "from 1 sure photo, 0 outliers" in text
    assert "chi-square" not in text
    assert "chi-square" in csv_text(made(row(7e-6), row(7e-6)))


def test_a_photo_of_another_lamp_is_matched_with_its_own_frequency() -> None:
    photo = photo_of(picture_of(SCENE.replace(switching_frequency=7e3), 4))
    table = occ.match_photos([photo], SCENE, sent="scene", known={0: 7e3})
    (found,) = table.rows
    assert found.given == 7e3
    assert found.readout_time == pytest.approx(9e-6, rel=2e-3), "one camera"
    assert found.exposure_time == pytest.approx(120e-6, rel=0.03)
    both = made(row(9e-6), found)
    rests_on = [line["rests on"] for line in csv.DictReader(csv_text(both).splitlines()[-3:])]
    assert rests_on == ["f = 5 kHz, given", "f = 7 kHz, given"]
    assert both.rests_on_the_scene


@pytest.mark.parametrize("photos", [[], ()])
def test_no_photos_are_refused(photos: list[Path]) -> None:
    with pytest.raises(occ.ParameterError, match="There are no photos to match"):
        occ.match_photos(photos, SCENE)


def test_what_is_no_path_is_refused() -> None:
    with pytest.raises(occ.PhotoError, match="7 is not the path of a photo"):
        occ.match_photos([7], SCENE)  # type: ignore[list-item]


def test_what_progress_raises_ends_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    matched: list[object] = []
    photo = photo_of(picture_of(SCENE, 1))

    def matching(place: int, *_: object) -> tuple[int, PhotoRow]:
        matched.append(place)
        return place, row(1e-5)

    def stop_after_two(done: int, _total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    monkeypatch.setattr(module, "row_of", matching)
    with pytest.raises(KeyboardInterrupt):
        occ.match_photos([photo] * 5, SCENE, progress=stop_after_two)
    assert len(matched) == 2

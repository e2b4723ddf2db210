"""A film written to a file is complete, can be opened, and states how it was made."""

import resource
import struct
import tracemalloc
from collections.abc import Generator
from contextlib import closing, suppress
from itertools import islice
from pathlib import Path

import cv2
import numpy as np
import pytest
from films import stripes
from PIL import Image

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.scene.scene import Scene
from occ_model.video.file.note import read_note
from occ_model.video.file.write import FILM_ENDINGS, LOSSLESS, check_film_path, write_frames

SCENE = Scene().replace(rows=120, columns=160, readout_time=1e-4, distance=0.8, payload="text:été")
RECORDING = occ.Recording(
    frame_rate=24.975,
    frame_jitter=1e-4,
    camera_drift=2e-5,
    transmitter_drift=-1e-5,
    path=(occ.Waypoint(0.0), occ.Waypoint(0.5, offset_x=0.1, roll=-0.01)),
    exposure_times=(1e-4, 3e-4),
    frame_times="nominal",
)


@pytest.fixture(scope="module")
def film() -> occ.Video:
    return occ.render_video(SCENE, 7, RECORDING)


@pytest.mark.parametrize("ending", FILM_ENDINGS)
def test_a_film_is_read_back_as_it_was_written(
    tmp_path: Path, film: occ.Video, ending: str
) -> None:
    path, done = tmp_path / f"film{ending}", list[int]()
    assert occ.write_video(film, path, done.append) == 7
    assert done == [1, 2, 3, 4, 5, 6, 7]
    assert list(tmp_path.iterdir()) == [path]
    back = occ.load_video(path)
    assert (back.scene, back.recording) == (SCENE, RECORDING)
    assert (back.frame_count, back.shape, back.problem) == (7, film.shape, None)
    pairs = list(zip(film, back, strict=True))
    for made, read in pairs:
        assert read.time == pytest.approx(made.time, abs=back.times.resolution / 2 + 1e-9)
        assert read.exposure_time == made.exposure_time
        error = read.image.astype(float) - made.image
        if ending in LOSSLESS:
            assert not error.any()
        else:  # the codec's error, which is large because of the noise, and that of a column's mean
            assert np.sqrt(np.mean(error**2)) < 8
            assert np.sqrt(np.mean(error.mean(axis=0) ** 2)) < 2
    assert back.problem is None
    assert back.frame_rate == pytest.approx(24.975, rel=1e-3 if ending != ".gif" else 0.05)


@pytest.mark.parametrize("ending", FILM_ENDINGS)
def test_other_programs_open_it(tmp_path: Path, film: occ.Video, ending: str) -> None:
    path = tmp_path / f"film{ending}"
    occ.write_video(film, path)
    if ending in (".gif", ".png"):
        with Image.open(path) as picture:
            assert (picture.n_frames, picture.size) == (7, (160, 120))  # type: ignore[attr-defined]
            assert picture.info["loop"] == 0  # repeated endlessly
            picture.seek(6)
            last = np.asarray(picture.convert("L"))
        np.testing.assert_array_equal(last, film.frame(6).image)
    else:
        capture = cv2.VideoCapture(str(path))
        frames = [capture.read()[0] for _ in range(8)]
        capture.release()
        assert frames == [True] * 7 + [False]


def test_the_parts_of_a_png_film_follow_the_standard(tmp_path: Path) -> None:
    path = tmp_path / "film.png"
    write_frames(path, (stripes(n) for n in range(3)), 29.97, "a note")
    content, place, names, order = path.read_bytes(), 8, [], []
    while place < len(content):
        size, name = struct.unpack_from(">I4s", content, place)
        names.append(name.decode())
        if name in (b"fcTL", b"fdAT"):
            order.append(struct.unpack_from(">I", content, place + 8)[0])
        if name == b"fcTL":
            assert struct.unpack_from(">HH", content, place + 28) == (100, 2997)
        place += 12 + size
    assert names == [
        "IHDR", "acTL", "iTXt", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL", "fdAT", "IEND",
    ]  # fmt: skip
    assert order == [0, 1, 2, 3, 4]


def test_rounding_errors_of_a_gif_films_times_do_not_add_up(tmp_path: Path) -> None:
    path = tmp_path / "film.gif"
    write_frames(path, (stripes(n) for n in range(61)), 30.0, "")
    times = [frame.time for frame in occ.load_video(path)]
    assert times == pytest.approx([n / 30 for n in range(61)], abs=0.0051)


def test_a_film_of_odd_size_keeps_it_if_the_codec_can(tmp_path: Path) -> None:
    odd = [stripes(n, 45, 63) for n in range(2)]
    for ending in LOSSLESS:
        path = tmp_path / f"film{ending}"
        write_frames(path, odd, 25.0, "")
        image = occ.load_video(path, "columns").frame(1).image
        np.testing.assert_array_equal(image, odd[1])


@pytest.mark.parametrize("ending", FILM_ENDINGS)
def test_colours_are_kept(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"film{ending}"
    colours = np.zeros((32, 48, 3), np.uint8)
    colours[...] = (200, 100, 50)
    assert write_frames(path, [colours, colours], 10.0, "colours") == 2
    for channel, level in [("red", 200), ("green", 100), ("blue", 50)]:
        image = occ.load_video(path, channel=channel).frame(1).image
        assert abs(float(np.median(image)) - level) <= (0 if ending in LOSSLESS else 4)
    assert read_note(path) == "colours"


def test_an_interrupted_film_leaves_the_older_file(tmp_path: Path, film: occ.Video) -> None:
    def end(done: int) -> None:
        if done == 3:
            raise KeyboardInterrupt

    for ending in FILM_ENDINGS:
        path = tmp_path / f"film{ending}"
        path.write_text("older")
        with pytest.raises(KeyboardInterrupt):
            occ.write_video(film, path, end)
        assert path.read_text() == "older"
    assert len(list(tmp_path.iterdir())) == len(FILM_ENDINGS)


@pytest.mark.parametrize(
    ("name", "frames", "rate", "words"),
    [
        ("a.avi", 2, 30.0, "a.avi does not have the ending of a film; use .mp4, .mkv"),
        ("none/a.mp4", 2, 30.0, "none"),
        ("a.gif", 2, 60.0, r"60 frames a second; allowed in a GIF file: 0\.002 to 50\."),
        ("a.gif", None, 60.0, "60 frames a second"),
        ("a.mp4", None, 30.0, "a film without end"),
    ],
)
def test_a_film_that_cannot_be_written_is_refused_before_any_frame_is_simulated(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    name: str,
    frames: int | None,
    rate: float,
    words: str,
) -> None:
    """Simulation can take hours."""
    film = occ.render_video(SCENE, frames, occ.Recording(frame_rate=rate))
    monkeypatch.setattr(
        type(film), "__iter__", lambda _: pytest.fail("a frame was asked for"), raising=False
    )
    with pytest.raises(occ.OccError, match=words):
        occ.write_video(film, tmp_path / name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", FILM_ENDINGS)
def test_the_memory_for_writing_does_not_grow_with_the_film(tmp_path: Path, ending: str) -> None:
    pictures = [stripes(n, 200, 300) for n in range(16)]
    peaks = []
    for frames in (10, 60):
        tracemalloc.start()
        endless = (picture for _ in range(frames) for picture in pictures)
        write_frames(tmp_path / f"a{ending}", islice(endless, frames), 30.0, "")
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.2 * peaks[0]


def test_a_film_opened_and_written_again_keeps_its_note(tmp_path: Path, film: occ.Video) -> None:
    first, second = tmp_path / "a.mkv", tmp_path / "b.png"
    occ.write_video(film, first)
    occ.write_video(occ.load_video(first), second)
    again = occ.load_video(second)
    assert (again.scene, again.recording) == (SCENE, RECORDING)
    np.testing.assert_array_equal(again.frame(5).image, film.frame(5).image)


@pytest.mark.parametrize(
    "note", ["", "scene x:\nfrequency = 3", "scene x:\n[camera]\niso = -1", "recording.path = 3"]
)
def test_a_meaningless_note_is_ignored(tmp_path: Path, note: str) -> None:
    path = tmp_path / "film.mp4"
    write_frames(path, [stripes(0), stripes(1)], 30.0, note)
    back = occ.load_video(path)
    assert back.scene is None
    assert len(list(back)) == 2


_NO_LIMIT = (resource.RLIM_INFINITY, resource.RLIM_INFINITY)


def full_disk(first: int, last: int) -> Generator[ByteArray, None, None]:
    """Yield frames, during some of which no file can grow, as on a disk that is briefly full."""
    noise = np.random.default_rng(1).integers(0, 256, (40, 192, 256), dtype=np.uint8)
    try:
        for number, picture in enumerate(noise):
            if number in (first, last):
                end = 1 if number == first else resource.RLIM_INFINITY
                resource.setrlimit(resource.RLIMIT_FSIZE, (end, resource.RLIM_INFINITY))
            yield picture
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, _NO_LIMIT)


def open_files() -> list[str]:
    found = []
    for each in Path("/proc/self/fd").iterdir():
        with suppress(OSError):  # the folder's own descriptor
            found.append(str(each.readlink()))
    return found


@pytest.mark.parametrize(("first", "last"), [(0, 39), (10, 30), (30, 40)])
@pytest.mark.parametrize("ending", FILM_ENDINGS)
def test_a_briefly_full_disk_leaves_only_the_older_file(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], ending: str, first: int, last: int
) -> None:
    path = tmp_path / f"film{ending}"
    path.write_text("older")
    # Closed, because references to a failed film's frames would keep the disk full.
    with (
        pytest.raises(occ.OutputError, match=r"film\.... cannot be written: |can be started: "),
        closing(full_disk(first, last)) as frames,
    ):
        write_frames(path, frames, 30.0, "")
    assert path.read_text() == "older"
    assert list(tmp_path.iterdir()) == [path]
    # A removed file that is still open takes space.
    assert not [each for each in open_files() if str(tmp_path) in each]
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("ending", FILM_ENDINGS)
@pytest.mark.parametrize(
    ("frames", "words"),
    [
        ([], "the film has no frames"),
        ([stripes(0), stripes(1, 40)], "a frame has another size than the first"),
    ],
)
def test_invalid_frames_leave_no_file(
    tmp_path: Path, frames: list[ByteArray], words: str, ending: str
) -> None:
    with pytest.raises(occ.OutputError, match=f"a{ending} is not written: {words}"):
        write_frames(tmp_path / f"a{ending}", frames, 30.0, "")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", FILM_ENDINGS)
@pytest.mark.parametrize("rate", [1e-9, 0.009, 0.01, 30.0, 50.0, 65_535.0, 65_600.0, 1e5, 1e9])
def test_a_rate_is_refused_before_any_work_or_the_film_is_written(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], ending: str, rate: float
) -> None:
    path = tmp_path / f"a{ending}"
    try:
        check_film_path(path, rate)
    except occ.OutputError as refusal:
        assert f"cannot have {rate:g} frames a second; allowed in a" in str(refusal)  # noqa: PT017
    else:
        assert write_frames(path, [stripes(n) for n in range(3)], rate, "") == 3
        step = occ.load_video(path).times.resolution
        times = [frame.time for frame in occ.load_video(path)]
        assert times == pytest.approx([0.0, 1 / rate, 2 / rate], rel=1e-3, abs=step / 2 + 1e-9)
    assert capfd.readouterr() == ("", "")


def test_a_film_of_one_row_is_refused_in_its_own_size(tmp_path: Path) -> None:
    low = occ.render_video(SCENE.replace(rows=1), 2)
    with pytest.raises(
        occ.OutputError, match=r"cannot have 160 x 1 pixels; allowed in an MP4 file: from 2 a side"
    ):
        occ.write_video(low, tmp_path / "a.mp4")
    for ending in LOSSLESS:
        assert occ.write_video(low, tmp_path / f"a{ending}") == 2

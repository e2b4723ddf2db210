"""Films are read from files with their frames, times, levels and axes."""

import gc
import os
import signal
import subprocess
import sys
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from films import (
    COLUMNS,
    KINDS,
    LINES,
    RATE,
    film_bytes,
    repeat_first,
    stripes,
    write_film,
)
from PIL import Image

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.video.file import decoder_process

_MEMORY = Path(__file__).parents[2] / "benchmarks" / "memory.py"


def saved(folder: Path, content: bytes, ending: str = "mp4") -> Path:
    path = folder / f"film.{ending}"
    path.write_bytes(content)
    return path


def memory_of(*work: str) -> list[int]:
    """Measure the memory of some work in a new process, as this one has done other work."""
    command = [sys.executable, str(_MEMORY), *work]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    return [int(number) for number in ran.stdout.split()]


def error_of(image: ByteArray, number: int) -> float:
    """Return the RMS difference of a frame from the stripes that were written."""
    return float(np.sqrt(np.mean((image.astype(float) - stripes(number)) ** 2)))


@pytest.mark.parametrize(("ending", "codec"), KINDS)
def test_every_kind_of_film_gives_frames_levels_and_times(
    tmp_path: Path, ending: str, codec: str
) -> None:
    film = occ.load_video(saved(tmp_path, film_bytes(ending, codec), ending))
    frames = list(film)
    assert (len(frames), film.frame_count, film.frame_rate) == (20, 20, RATE)
    assert (film.shape, film.problem, film.simulated) == ((LINES, COLUMNS), None, False)
    step = film.times.resolution
    assert [frame.time for frame in frames] == pytest.approx(
        [number / RATE for number in range(20)], abs=step / 2 + 1e-12
    )
    # Lossy codecs soften the stripes' edges; levels from 16 to 235 are stretched to 0 to 255.
    assert max(error_of(frame.image, frame.index) for frame in frames) < 12
    levels = [np.percentile(frame.image[LINES // 2 :], (25, 75)) for frame in frames]
    np.testing.assert_allclose(levels, np.tile((20, 235), (20, 1)), atol=4)
    film.close()


@pytest.mark.parametrize(("ending", "codec"), [KINDS[0], KINDS[3], KINDS[9]])
def test_frames_can_be_read_in_any_order(tmp_path: Path, ending: str, codec: str) -> None:
    film = occ.load_video(saved(tmp_path, film_bytes(ending, codec), ending))
    before = film.frame(17)  # before any times are known
    frames = list(film)
    np.testing.assert_array_equal(before.image, frames[17].image)
    for index in (3, 4, 9, 2, 19, 0, 18, 17, 17):
        frame = film.frame(index)
        assert (frame.index, frame.time) == (index, frames[index].time)
        np.testing.assert_array_equal(frame.image, frames[index].image)
    assert [frame.index for frame in film.frames(18)] == [18, 19]
    assert list(film.frames(20)) == []
    for absent in (20, 1000, -1):
        with pytest.raises(occ.ParameterError, match=f"index is {absent}; allowed: "):
            film.frame(absent)


def test_a_film_of_unequal_steps_that_states_only_its_duration_is_complete(tmp_path: Path) -> None:
    halved = [number / 2 if number < 10 else number for number in range(20)]
    path = tmp_path / "film.mkv"
    milliseconds = [round(1000 * each / RATE) for each in halved]
    write_film(path, "FFV1", map(stripes, range(20)), milliseconds=milliseconds)
    film = occ.load_video(path)
    frames = list(film)
    assert len(frames) == 20
    assert [frame.time * RATE for frame in frames] == pytest.approx(halved, abs=0.03)
    assert (film.problem, film.frame_count) == (None, 20)
    for index in (12, 3, 19):
        np.testing.assert_array_equal(film.frame(index).image, frames[index].image)


def test_the_scan_axis_is_found_from_the_first_frames_and_kept(tmp_path: Path) -> None:
    lying = [np.full((COLUMNS, LINES), 90, np.uint8), *(stripes(n).T for n in range(6))]
    path = tmp_path / "film.avi"
    write_film(path, "MJPG", lying, size=(COLUMNS, LINES))
    film = occ.load_video(path)
    assert film.turned
    assert film.shape == (LINES, COLUMNS)
    assert error_of(film.frame(3).image, 2) < 12
    assert occ.load_video(path, scan_axis="columns").shape == (COLUMNS, LINES)


@pytest.mark.parametrize("ending", ["gif", "png"])
def test_animated_pictures_are_films_too(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"a.{ending}"
    shown = [stripes(n, 45, 63) for n in range(5)]  # odd sizes
    first, *others = [Image.fromarray(picture) for picture in shown]
    steps = [100, 50, 30, 200, 40]
    first.save(path, save_all=True, append_images=others, duration=steps, loop=0)
    film = occ.load_video(path)
    frames = list(film)
    assert [frame.time for frame in frames] == pytest.approx([0, 0.1, 0.15, 0.18, 0.38])
    assert (film.frame_count, film.shape, film.problem) == (5, (45, 63), None)
    for frame, picture in zip(frames, shown, strict=True):
        np.testing.assert_array_equal(frame.image, picture)
    np.testing.assert_array_equal(film.frame(1).image, shown[1])


def test_an_animated_picture_has_colour_channels_and_transparent_parts_are_black(
    tmp_path: Path,
) -> None:
    first = np.full((20, 30, 4), (200, 100, 50, 255), np.uint8)
    second = first.copy()
    second[:10, :, 3] = 0
    second[10, 0, 3] = 128
    opaque, other = (Image.fromarray(pixels) for pixels in (first, second))
    path = tmp_path / "a.png"
    opaque.save(path, save_all=True, append_images=[other], duration=[40, 60], blend=0)
    for channel, level in [("blue", 50), ("luma", 124)]:
        film = occ.load_video(path, "columns", channel=channel)
        assert (film.frame_count, film.frame_rate) == (2, 25.0)
        assert (film.frame(0).image == level).all()
        assert list(film.frames(2)) == []
        (seen,) = film.frames(1)  # the first one is skipped
        assert seen.time == pytest.approx(0.04)
        assert {*seen.image[:10].flat} == {0}
        assert {*seen.image[11:].flat} == {level}
        assert seen.image[10, 0] == pytest.approx(level * 128 / 255, abs=1)


@pytest.mark.parametrize(
    ("ending", "codec", "length"),
    [("mov", "mp4v", ""), ("avi", "MJPG", "0.667"), ("mkv", "FFV1", "0.666")],
)
def test_a_truncated_film_gives_its_frames_and_states_the_damage(
    tmp_path: Path, ending: str, codec: str, length: str
) -> None:
    content = film_bytes(ending, codec)
    if ending == "mov":  # with the table of frames at the end
        blanked = content.index(b"mdat") + 900
        content = content[:blanked] + bytes(600) + content[blanked + 600 :]
    else:
        content = content[: len(content) // 2]
    film = occ.load_video(saved(tmp_path, content, ending))
    held = list(film)
    if ending == "mov":  # the decoder fills in missing parts or omits a frame
        assert 15 <= len(held) <= 20
    else:
        assert 5 <= len(held) <= 15
        stated = f"ends after {held[-1].time:.3g} s of the {length} s"
        assert film.problem == f"{film.path} {stated} that it states: it may be cut off or damaged."
        assert max(error_of(frame.image, frame.index) for frame in held[:-1]) < 12


ADDRESSES = [
    ("film.mp4", b"#EXTM3U\n#EXTINF:1,\nhttp://127.0.0.1:9/a.ts\n#EXT-X-ENDLIST\n"),
    ("film.mp4", b"ffconcat version 1.0\nfile other.mp4\n"),
    ("film.m3u8", b"#EXTM3U\n#EXTINF:1,\nother.mp4\n#EXT-X-ENDLIST\n"),
    ("film.sdp", b"v=0\no=- 0 0 IN IP4 127.0.0.1\nm=video 5004 RTP/AVP 96\n"),
    ("film.mkv", b"a text"),
]


@pytest.mark.parametrize(("name", "content"), ADDRESSES)
def test_a_list_of_other_files_or_addresses_is_not_a_film(
    tmp_path: Path, name: str, content: bytes
) -> None:
    (tmp_path / "other.mp4").write_bytes(film_bytes("mp4", "mp4v"))
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(occ.VideoError, match="is not a film that can be read; allowed: MP4, MOV"):
        occ.load_video(path)


@pytest.mark.parametrize(
    "name",
    [
        "http://127.0.0.1:9/film.mp4", "rtsp://127.0.0.1/film", "concat:film.mp4|film.mp4",
        "file:film.mp4", "subfile,,start,0,end,9,,:film.mp4", "0", "/dev/video0", "",
    ],
)  # fmt: skip
def test_an_address_is_not_a_file(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    saved(tmp_path, film_bytes("mp4", "mp4v"))
    monkeypatch.chdir(tmp_path)
    with pytest.raises(occ.VideoError, match=r"cannot be read"):
        occ.load_video(name)


@pytest.mark.parametrize("name", ["concat:a|b.mp4", "a%03d.mp4", "ä ;-.mp4", "-i.mp4"])
def test_a_film_may_have_any_name(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(name).write_bytes(film_bytes("mp4", "mp4v"))
    assert occ.load_video(name).frame(19).index == 19


def test_anything_but_a_regular_file_is_refused(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.mp4"
    os.mkfifo(pipe)
    for path in (pipe, tmp_path, tmp_path / "none.mp4", "a\0b.mp4"):
        with pytest.raises(occ.VideoError, match="cannot be read"):
            occ.load_video(path)
    with pytest.raises(occ.VideoError, match="3 is not the path of a film"):
        occ.load_video(3)  # type: ignore[arg-type]
    with pytest.raises(occ.VideoError, match="is not a film that can be read"):
        occ.load_video(saved(tmp_path, b""))


def test_a_huge_frame_is_refused_before_it_is_decoded(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.new("1", (9000, 9000)).save(path)
    with pytest.raises(occ.VideoError, match=r"9,000 x 9,000 pixels; allowed: from 1 to 36 mill"):
        occ.load_video(path)


def test_a_frame_that_is_larger_than_stated_does_not_fill_the_memory(tmp_path: Path) -> None:
    # Each key frame of VP8 has its own size; the container states that of the first.
    content = film_bytes("mkv", "VP80")
    own = b"\x9d\x01\x2a" + bytes((COLUMNS, 0, LINES, 0))
    assert content.count(own) == 2
    place = content.rindex(own)
    huge = content[: place + 3] + b"\xff\x3f\xff\x3f" + content[place + 7 :]
    film = occ.load_video(saved(tmp_path, huge, "mkv"))
    assert 0 < len(list(film)) < 20
    assert film.problem.startswith(str(film.path))


def test_nothing_is_printed_and_the_environment_is_unchanged(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    content = bytearray(film_bytes("mp4", "mp4v"))
    place = content.index(b"mdat")
    content[place + 900 : place + 1500] = bytes(600)
    before = dict(os.environ)
    list(occ.load_video(saved(tmp_path, bytes(content))))
    with pytest.raises(occ.VideoError):
        occ.load_video(saved(tmp_path, bytes(content[:60])))
    assert capfd.readouterr() == ("", "")
    assert dict(os.environ) == before


def decoders() -> list[int]:
    """Return the decoding processes that this one has started and that still run."""
    here = os.getpid()
    tasks = Path(f"/proc/{here}/task").glob("*/children")
    children = {int(child) for task in tasks for child in task.read_text().split()}
    commands = {child: Path(f"/proc/{child}/cmdline").read_bytes() for child in children}
    return sorted(child for child, command in commands.items() if b"decoder_main" in command)


@pytest.mark.skipif(sys.platform != "linux", reason="finds processes in Linux's /proc")
def test_a_dead_decoder_ends_the_film_with_a_sentence_and_the_next_film_gets_a_new_one(
    tmp_path: Path,
) -> None:
    film = occ.load_video(saved(tmp_path, film_bytes("mp4", "mp4v")))
    frames = iter(film)
    seen = [next(frames) for _ in range(7)]
    for decoder in decoders():
        os.kill(decoder, signal.SIGKILL)
    seen += frames
    assert len(seen) in (7, 8)  # another one is decoded in advance
    index = len(seen)
    assert film.problem == (
        f"{film.path} ends early: frame {index} cannot be read: the decoder failed."
    )
    assert len(list(film)) == 20


_BUSY = """
import sys
sys.path.insert(0, sys.argv[1])
from occ_model.video.file import av_source, decoder_main
decoder_main.LONGEST_REQUEST = 0.3
usual = av_source.AvSource.read
def read(self):
    frame = usual(self)
    while frame is not None and frame.time > 0.3:
        pass
    return frame
av_source.AvSource.read = read
decoder_main.main()
"""


def test_a_decoder_that_takes_too_long_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(decoder_process, "START", _BUSY)
    monkeypatch.setattr(decoder_process, "spare", [])
    film = occ.load_video(saved(tmp_path, film_bytes("mp4", "mp4v")))
    assert len(list(film)) == 10
    assert film.problem == (
        f"{film.path} ends early: frame 10 cannot be read: decoding it takes too long."
    )
    with pytest.raises(occ.VideoError, match=r"Frame 15 of .* cannot be read: .* takes too long"):
        film.frame(15)


_POOR = """
import sys
sys.path.insert(0, sys.argv[1])
from occ_model.video.file import decoder_main
decoder_main.MOST_MEMORY = 30_000_000
decoder_main.main()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits a process's memory")
def test_a_film_that_takes_too_much_memory_is_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "film.mp4"
    write_film(path, "mp4v", [stripes(0, 2160, 3840)], size=(2160, 3840))
    monkeypatch.setattr(decoder_process, "spare", [])
    monkeypatch.setattr(decoder_process, "START", _POOR)
    with pytest.raises(occ.VideoError, match="read: decoding it takes more memory than is allowed"):
        occ.load_video(path)


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a shell script")
def test_a_bundled_program_becomes_its_own_decoder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "program"
    start = Path(__file__).parents[3] / "resources" / "packaging" / "shell.py"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{start}" "$@"\n')
    program.chmod(0o755)
    monkeypatch.setattr(sys, "executable", str(program))
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    monkeypatch.setattr(decoder_process, "spare", [])
    film = occ.load_video(saved(tmp_path, film_bytes("mp4", "mp4v")))
    assert len(list(film)) == 20


@pytest.mark.skipif(sys.platform != "linux", reason="finds processes in Linux's /proc")
def test_films_no_longer_used_leave_one_process_for_the_next(tmp_path: Path) -> None:
    path = saved(tmp_path, film_bytes("mp4", "mp4v"))
    films = [occ.load_video(path) for _ in range(3)]
    for film in films:
        film.frame(4)
    started = decoders()
    assert len(started) == 3
    del film, films
    gc.collect()
    (kept,) = decoders()
    assert kept in started
    frames = iter(occ.load_video(path))
    next(frames)
    del frames
    assert decoders() == [kept]


def test_a_long_film_has_its_stated_length_and_each_frame_can_be_read(tmp_path: Path) -> None:
    film = occ.load_video(saved(tmp_path, repeat_first(film_bytes("mov", "MJPG"), 18_000), "mov"))
    assert film.frame_count == 18_000
    first, last = film.frame(0), film.frame(17_999)
    np.testing.assert_array_equal(first.image, last.image)
    assert last.time == pytest.approx(17_999 / RATE)
    assert [frame.index for frame in islice(film, 2)] == [0, 1]


@pytest.mark.whole
@pytest.mark.skipif(sys.platform != "linux", reason="reads the memory from Linux's /proc")
@pytest.mark.parametrize(("ending", "codec"), [("mov", "MJPG"), ("mp4", "mp4v"), ("webm", "VP90")])
def test_ten_minutes_of_4k_stay_within_400_megabytes(
    tmp_path: Path, ending: str, codec: str
) -> None:
    path = tmp_path / f"film.{ending}"
    write_film(path, codec, (stripes(n, 2160, 3840) for n in range(8)), size=(2160, 3840))
    if codec == "MJPG":
        path.write_bytes(repeat_first(path.read_bytes(), 18_000))
    frames, early, late = memory_of("film", str(path))
    assert frames == (60 if codec == "MJPG" else 8)
    assert late < 400_000_000
    assert late < 1.1 * early


def test_a_film_ends_at_an_impossible_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("occ_model.video.load.LATEST_TIME", 0.2)
    film = occ.load_video(saved(tmp_path, film_bytes("mp4", "mp4v")))
    assert [frame.index for frame in film] == list(range(7))
    assert "the time of frame 7 is 0.233 s; allowed: -0.2 to 0.2 s." in film.problem

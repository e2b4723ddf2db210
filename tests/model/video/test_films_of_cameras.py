"""Films as cameras write them: levels, orientation, fields, times, and edits."""

import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import av
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

import occ_model as occ
from occ_model.arrays import ByteArray

LINES, COLUMNS, RATE = 48, 64, 30
FULL, LIMITED = 2, 1
QUIET = {"x265-params": "log-level=none:lossless=1:bframes=0"}


@dataclass(frozen=True)
class Encoder:
    """How a film is written; ``form``: of its pixels."""

    name: str
    form: str = "yuv420p"
    options: dict[str, str] | None = None
    extent: int = 0  # the stated range of levels
    rate: Fraction = Fraction(RATE)
    tags: dict[str, str] | None = None
    matrix: Sequence[int] | None = None


def write(path: Path, encoder: Encoder, lumas: Iterable[NDArray[Any]], *times: int) -> Path:
    """Write planes of luma, colourless; ``times``: of the frames, in steps of the rate."""
    options = {"movflags": "use_metadata_tags"} if encoder.tags else {}
    with av.open(path, "w", options=options) as container:
        container.metadata.update(encoder.tags or {})
        stream: Any = container.add_stream(encoder.name, encoder.rate, dict(encoder.options or {}))
        stream.pix_fmt, stream.codec_context.color_range = encoder.form, encoder.extent
        if encoder.matrix is not None:
            stream.set_display_matrix(list(encoder.matrix))
        for number, luma in enumerate(lumas):
            if number == 0:
                stream.height, stream.width = luma.shape
            frame = av.VideoFrame(luma.shape[1], luma.shape[0], encoder.form)
            frame.color_range = encoder.extent
            for index, plane in enumerate(frame.planes):
                kind = luma.dtype
                content = np.full(plane.buffer_size // kind.itemsize, _grey(encoder.form), kind)
                if index == 0:
                    lines = content.reshape(-1, plane.line_size // kind.itemsize)
                    lines[: luma.shape[0], : luma.shape[1]] = luma
                plane.update(content.tobytes())
            frame.pts = times[number] if times else number
            container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    return path


def _grey(form: str) -> int:
    return 1 << (av.VideoFormat(form).components[0].bits - 1)


def ramp(bits: int) -> NDArray[Any]:
    """Every level of some bits, or as many as there are pixels, in a picture."""
    kind = np.uint8 if bits == 8 else np.uint16
    levels = np.linspace(0, 2**bits - 1, LINES * COLUMNS)
    return np.rint(levels).astype(kind).reshape(LINES, COLUMNS)


LEVELS = [
    ("mkv", Encoder("ffv1", "yuv420p"), False),
    ("mkv", Encoder("ffv1", "gray"), True),
    ("mkv", Encoder("ffv1", "gray16le"), True),
    ("mkv", Encoder("ffv1", "yuv422p12le", extent=FULL), True),
    ("mkv", Encoder("ffv1", "yuv444p10le", extent=LIMITED), False),
    ("mp4", Encoder("libx264", "yuvj420p", {"qp": "0"}, FULL), True),
    ("mp4", Encoder("libx264", "yuv420p", {"qp": "0"}), False),
    ("mkv", Encoder("libx265", "gray", QUIET, LIMITED), False),
    ("mkv", Encoder("libx265", "yuv420p10le", QUIET, FULL), True),
    ("webm", Encoder("libvpx-vp9", "yuv420p", {"lossless": "1"}, FULL), True),
    ("webm", Encoder("libvpx-vp9", "yuv420p", {"lossless": "1"}), False),
    ("mov", Encoder("v210", "yuv422p10le"), False),
]


@pytest.mark.parametrize(("ending", "encoder", "is_full"), LEVELS)
def test_luma_is_the_files_own_at_its_depth_and_range(
    tmp_path: Path, ending: str, encoder: Encoder, is_full: bool
) -> None:
    """Recommendation ITU-R BT.2100, table 9: quantization of narrow and full range."""
    bits = av.VideoFormat(encoder.form).components[0].bits
    luma = ramp(bits)
    if encoder.name == "v210":  # which reserves the ends
        luma = luma.clip(4, 1019)
    path = write(tmp_path / f"a.{ending}", encoder, [luma, luma])
    frame = occ.load_video(path, "columns").frame(1)
    if is_full:
        fraction = luma / (2**bits - 1)
    else:
        fraction = ((luma / 2.0 ** (bits - 8) - 16.0) / 219.0).clip(0.0, 1.0)
    np.testing.assert_array_equal(frame.image, np.rint(255.0 * fraction))
    assert (frame.samples is None) == (bits == 8)
    if frame.samples is not None:
        assert np.abs(frame.samples - 65_535.0 * fraction).max() <= 0.5


@pytest.mark.parametrize("form", ["uyvy422", "yuyv422", "nv12"])
def test_luma_that_shares_its_plane_is_the_files_own_too(tmp_path: Path, form: str) -> None:
    from occ_model.video.file.channels import ChannelReader

    planar = av.VideoFrame(COLUMNS, LINES, "yuv422p")
    for plane in planar.planes:
        plane.update(
            bytes(range(16, 236)) * (plane.buffer_size // 220) + bytes(plane.buffer_size % 220)
        )
    packed = planar.reformat(format=form, threads=1)
    expected = ChannelReader("luma", "rawvideo").read(planar)
    found = ChannelReader("luma", "rawvideo").read(packed)
    np.testing.assert_array_equal(
        np.rint(found / (257 if found.dtype == np.uint16 else 1)), expected
    )


@pytest.mark.parametrize(("form", "white"), [("bayer_rggb16le", 65_535), ("bayer_rggb8", 255)])
def test_a_mosaic_keeps_its_bits(form: str, white: int) -> None:
    """An even mosaic, as CineForm RAW has it, is grey of the level that it stores."""
    from occ_model.video.file.channels import ChannelReader

    frame = av.VideoFrame(COLUMNS, LINES, form)
    kind = np.dtype("<u2" if white > 255 else np.uint8)
    level = white // 60
    frame.planes[0].update(np.full((LINES, COLUMNS), level, kind).tobytes())
    found = ChannelReader("luma", "cfhd").read(frame)
    assert found.dtype == kind.newbyteorder("=")
    np.testing.assert_array_equal(found, level)


@pytest.mark.parametrize("luma_of", [(1, 0.2126, 0.0722), (6, 0.299, 0.114)])
def test_colours_are_those_of_the_stated_matrix(
    tmp_path: Path, luma_of: tuple[int, float, float]
) -> None:
    matrix, red_part, blue_part = luma_of
    red, green, blue = 200, 100, 50
    luma = red_part * red + (1.0 - red_part - blue_part) * green + blue_part * blue
    stored = (
        16.0 + 219.0 / 255.0 * luma,
        128.0 + 224.0 / 255.0 * (blue - luma) / (2.0 - 2.0 * blue_part),
        128.0 + 224.0 / 255.0 * (red - luma) / (2.0 - 2.0 * red_part),
    )
    path = tmp_path / "a.mkv"
    with av.open(path, "w") as container:
        stream: Any = container.add_stream("ffv1", RATE)
        stream.width, stream.height, stream.pix_fmt = COLUMNS, LINES, "yuv444p"
        stream.codec_context.colorspace = matrix
        frame = av.VideoFrame(COLUMNS, LINES, "yuv444p")
        for plane, level in zip(frame.planes, stored, strict=True):
            plane.update(bytes([round(level)]) * plane.buffer_size)
        frame.pts = 0
        container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    for channel, level in [("red", red), ("green", green), ("blue", blue), ("luma", luma)]:
        image = occ.load_video(path, "columns", channel=channel).frame(0).image
        assert np.abs(image - float(level)).max() <= 1.5, channel


UNIT = 1 << 16
MATRICES = [
    (a, b, c, d)
    for (a, d), (b, c) in [
        *(((x, y), (0, 0)) for x, y in product((UNIT, -UNIT), repeat=2)),
        *(((0, 0), (x, y)) for x, y in product((UNIT, -UNIT), repeat=2)),
    ]
]


@pytest.mark.parametrize("matrix", MATRICES)
def test_a_film_is_turned_and_mirrored_as_its_track_states(
    tmp_path: Path, matrix: tuple[int, int, int, int]
) -> None:
    """ISO/IEC 14496-12: a pixel at (x, y) is shown at (a x + c y, b x + d y), from the corner."""
    a, b, c, d = (number // UNIT for number in matrix)
    stored = ramp(8)
    y, x = np.mgrid[:LINES, :COLUMNS]
    across, down = a * x + c * y, b * x + d * y
    shown = np.zeros((int(np.ptp(down)) + 1, int(np.ptp(across)) + 1))
    shown[down - down.min(), across - across.min()] = stored
    whole = (matrix[0], matrix[1], 0, matrix[2], matrix[3], 0, 0, 0, 1 << 30)
    encoder = Encoder("libx264", "yuvj420p", {"qp": "0"}, FULL, matrix=whole)
    path = write(tmp_path / "a.mp4", encoder, [stored])
    np.testing.assert_array_equal(occ.load_video(path, "columns").frame(0).image, shown)


def interlaced(pictures: Sequence[ByteArray], lower_first: bool) -> list[ByteArray]:
    """Take the lines of two pictures in turn for a frame, as a camera of fields does."""
    frames = []
    for first, second in zip(pictures[::2], pictures[1::2], strict=True):
        frame = first.copy()
        frame[1 - lower_first :: 2] = second[1 - lower_first :: 2]
        frames.append(frame)
    return frames


def interlaced_encoder(form: str, lower_first: bool) -> Encoder:
    parameters = f"qp=0:{'bff' if lower_first else 'tff'}=1"
    options = {"flags": "+ildct+ilme", "x264-params": parameters}
    return Encoder("libx264", form, options, FULL)


@pytest.mark.parametrize("lower_first", [False, True])
@pytest.mark.parametrize("ending", ["mp4", "mkv"])
def test_each_field_is_a_frame_with_its_own_lines_and_time(
    tmp_path: Path, ending: str, lower_first: bool
) -> None:
    pictures = [np.roll(ramp(8), 7 * number, axis=0) for number in range(8)]
    encoder = interlaced_encoder("yuv420p", lower_first)
    path = write(tmp_path / f"a.{ending}", encoder, interlaced(pictures, lower_first))
    film = occ.load_video(path, "lines")
    assert (film.line_step, film.frame_rate, film.frame_count) == (2, 2 * RATE, 8)
    assert film.shape == (COLUMNS, LINES // 2)
    frames = list(film)
    assert film.problem is None
    for number, (frame, picture) in enumerate(zip(frames, pictures, strict=True)):
        start = (number + lower_first) % 2
        np.testing.assert_array_equal(frame.image, picture[start::2].T)
        assert frame.time == pytest.approx(number / (2 * RATE), abs=film.times.resolution)
        assert frame.first_column == start / 2
    np.testing.assert_array_equal(film.frame(5).image, frames[5].image)
    assert occ.load_video(path, "columns").line_step == 1


@pytest.mark.parametrize(
    ("ending", "encoder"),
    [
        ("avi", Encoder("mpeg4", options={"flags": "+ildct+ilme"})),
        (
            "mkv",
            Encoder("libx265", options={"x265-params": "interlace=tff:log-level=none:bframes=0"}),
        ),
    ],
)
def test_fields_of_unknown_order_are_refused(tmp_path: Path, ending: str, encoder: Encoder) -> None:
    path = write(tmp_path / f"a.{ending}", encoder, [ramp(8)] * 2)
    with pytest.raises(occ.VideoError, match="interlaced, and does not say which of two fields"):
        occ.load_video(path)


SCENE = occ.load_preset("phone-136us").replace(
    rows=24, columns=540, readout_time=25e-6, switching_frequency=8e3, exposure_time=50e-6,
    payload="718",
)  # fmt: skip


@pytest.mark.parametrize("lower_first", [False, True])
def test_a_code_is_read_from_fields_with_the_clock_of_whole_frames(
    tmp_path: Path, lower_first: bool
) -> None:
    """Between whole frames, the clock of the fields has no error of half a line's time."""
    film = occ.render_video(SCENE, 24, occ.Recording(frame_rate=60.0))
    pictures = [np.ascontiguousarray(frame.image.T) for frame in film]
    encoder = interlaced_encoder("yuvj420p", lower_first)
    path = write(tmp_path / "a.mp4", encoder, interlaced(pictures, lower_first))
    reading = occ.decode_video(occ.load_video(path, "lines"), SCENE)
    assert (reading.payload, reading.failure) == ("718", None)
    assert "interlaced" in reading.problems[0]
    frequency, readout = reading.clock.switching_frequency, reading.clock.readout_time
    assert abs(frequency.value - 8e3) < 4.0 * frequency.error
    assert abs(readout.value - 50e-6) < 4.0 * readout.error
    assert reading.clock.timing_noise < 0.1 * 25e-6


@pytest.mark.parametrize(("captured", "slowdown"), [(240.0, 8.0), (30.0, 1.0), (0.5, 1.0 / 60.0)])
def test_slow_motion_and_time_lapse_have_the_times_of_the_recording(
    tmp_path: Path, captured: float, slowdown: float
) -> None:
    tags = {"com.android.capture.fps": f"{captured:f}"}
    encoder = Encoder("libx264", tags=tags)
    film = occ.load_video(write(tmp_path / "a.mp4", encoder, [ramp(8)] * 5))
    assert film.times.slowdown == pytest.approx(slowdown)
    assert film.frame_rate == pytest.approx(RATE * slowdown)
    assert [frame.time for frame in film] == pytest.approx(
        [number / (RATE * slowdown) for number in range(5)]
    )
    assert film.times.resolution == pytest.approx(1.0 / 15_360 / slowdown)
    assert film.problem is None


@pytest.mark.parametrize(
    ("ending", "name", "options", "resolution"),
    [
        ("mkv", "libx264", {"bf": "3", "x264-params": "open-gop=1"}, 1e-3),
        ("mp4", "libx264", {"bf": "3", "x264-params": "open-gop=1"}, 1.0 / 15_360),
        ("avi", "libx264", {"bf": "0"}, 0.0),
        ("avi", "mpeg4", {"qmin": "1", "qmax": "1"}, 0.0),
    ],
)
def test_a_frame_is_found_by_its_number_where_frames_are_dropped(
    tmp_path: Path, ending: str, name: str, options: dict[str, str], resolution: float
) -> None:
    """Each frame shows its number in its level."""
    times = [number + number // 17 * 2 for number in range(120)]
    pictures = [np.full((LINES, COLUMNS), 20 + number, np.uint8) for number in range(120)]
    encoder = Encoder(name, options={"g": "25", **options})
    path = write(tmp_path / f"a.{ending}", encoder, pictures, *times)
    film = occ.load_video(path)
    for number in (77, 3, 119, 50, 51, 24, 25, 26, 0):
        frame = film.frame(number)
        level = (20 + number - 16) * 255 / 219
        assert np.median(frame.image) == pytest.approx(level, abs=1.5), number
        assert frame.time == pytest.approx(times[number] / RATE, abs=resolution / 2 + 1e-9)
    assert film.times.resolution == pytest.approx(resolution)
    assert [frame.index for frame in film] == list(range(120))
    assert film.problem is None


@pytest.mark.parametrize("rate", [Fraction(60_000, 1001), Fraction(60)])
@pytest.mark.parametrize("ending", ["mp4", "mov", "avi", "mkv"])
def test_rates_of_television_are_told_from_whole_ones(
    tmp_path: Path, ending: str, rate: Fraction
) -> None:
    encoder = Encoder("libx264", rate=rate)
    film = occ.load_video(write(tmp_path / f"a.{ending}", encoder, [ramp(8)] * 30))
    last = list(film)[-1].time
    assert last == pytest.approx(29 / rate, abs=film.times.resolution / 2 + 1e-9)
    assert film.frame_rate == pytest.approx(float(rate), rel=1e-4)


def test_a_film_of_which_an_edit_shows_a_part_is_whole(tmp_path: Path) -> None:
    """Frames before the time 0 are stored and not shown, as where a phone has cut a film."""
    path = tmp_path / "a.mp4"
    encoder = Encoder("libx264", options={"g": "100", "bf": "3"})
    pictures = [np.full((LINES, COLUMNS), 20 + number, np.uint8) for number in range(24)]
    write(path, encoder, pictures, *range(-6, 18))
    film = occ.load_video(path)
    frames = list(film)
    assert (len(frames), film.frame_count, film.problem) == (18, 18, None)
    assert frames[0].image[0, 0] == pytest.approx((26 - 16) * 255 / 219, abs=1.5)
    assert film.frame(7).image[0, 0] == frames[7].image[0, 0]


EDITS = {  # of frames, as first and end, or of nothing for some frames
    "two pieces": [(10, 20), (40, 50)],
    "exchanged": [(40, 50), (10, 20)],
    "repeated": [(10, 20), (10, 20)],
    "late": [None, (10, 20)],
}


@pytest.mark.parametrize("edits", EDITS.values(), ids=EDITS)
def test_a_film_of_edits_shows_its_pieces_one_after_the_other(
    tmp_path: Path, edits: list[tuple[int, int] | None]
) -> None:
    path = tmp_path / "a.mp4"
    pictures = [np.full((LINES, COLUMNS), 20 + number, np.uint8) for number in range(60)]
    write(path, Encoder("libx264", options={"g": "20", "bf": "2"}), pictures)
    path.write_bytes(with_edits(path.read_bytes(), edits))
    shown = [number for piece in edits if piece for number in range(*piece)]
    film = occ.load_video(path)
    frames = list(film)
    assert (len(frames), film.frame_count, film.problem) == (len(shown), len(shown), None)
    for frame, number in zip(frames, shown, strict=True):
        assert frame.image[0, 0] == pytest.approx((4 + number) * 255 / 219, abs=1.5)
        assert frame.time == pytest.approx(frame.index / RATE, abs=1e-3)
    assert film.frame(len(shown) - 2).image[0, 0] == frames[-2].image[0, 0]


def with_edits(film: bytes, edits: list[tuple[int, int] | None]) -> bytes:
    """Give an MP4 film, whose boxes are at its end, another list of edits."""
    place = film.index(b"edts") - 4
    (size,) = struct.unpack_from(">I", film, place)
    (start,) = struct.unpack_from(">i", film, film.index(b"elst") + 16)
    unit = 15_360 // RATE
    rows = [
        (round(1000 / RATE * (end - first)), start + first * unit, 1, 0)
        for first, end in ((0, 0) if edit is None else edit for edit in edits)
    ]
    rows = [(500, -1, 1, 0) if edit is None else row for row, edit in zip(rows, edits, strict=True)]
    table = struct.pack(">II", 0, len(rows)) + b"".join(struct.pack(">IihH", *row) for row in rows)
    inner = struct.pack(">I4s", 8 + len(table), b"elst") + table
    new = struct.pack(">I4s", 8 + len(inner), b"edts") + inner
    changed = bytearray(film[:place] + new + film[place + size :])
    for outer in (b"moov", b"trak"):
        position = film.rindex(outer) - 4
        (old,) = struct.unpack_from(">I", changed, position)
        struct.pack_into(">I", changed, position, old + len(new) - size)
    return bytes(changed)


def test_the_picture_of_an_animation_for_other_programs_is_not_a_frame(tmp_path: Path) -> None:
    still, *shown = (Image.new("L", (20, 16), 10 * number) for number in range(6))
    path = tmp_path / "a.png"
    still.save(path, save_all=True, append_images=shown, default_image=True, duration=40)
    film = occ.load_video(path)
    assert film.frame_count == 5
    assert [(frame.time, frame.image[0, 0]) for frame in film] == [
        (pytest.approx(0.04 * number), 10 * number + 10) for number in range(5)
    ]


def test_16_bits_of_an_animated_png_are_kept(tmp_path: Path) -> None:
    from occ_model.video.file.write import write_frames

    path = tmp_path / "a.png"
    write_frames(path, [ramp(16), ramp(16)[::-1]], 10.0, "")
    frame = occ.load_video(path, "columns").frame(1)
    np.testing.assert_array_equal(frame.samples, ramp(16)[::-1])
    np.testing.assert_array_equal(frame.image, np.rint(ramp(16)[::-1] / 257.0))


def test_the_picture_of_a_songs_cover_is_not_a_film(tmp_path: Path) -> None:
    path = tmp_path / "a.mp4"
    with av.open(path, "w") as container:
        stream: Any = container.add_stream("png", RATE)
        stream.width, stream.height, stream.pix_fmt = 16, 16, "rgb24"
        stream.disposition = av.stream.Disposition.attached_pic
        frame = av.VideoFrame(16, 16, "rgb24")
        frame.pts = 0
        container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    with pytest.raises(occ.VideoError, match="no film was found"):
        occ.load_video(path)

"""RAW files: the light of the green photosites, line by line of the sensor."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest
import tifffile
from numpy.typing import NDArray
from raw_files import PATTERNS, light_of, mosaic_of, overwrite, write_dng

import occ_model as occ
from occ_model.photo.reading.raw import is_raw
from occ_model.scene.scene import Scene

LINES, COLUMNS = 900, 120


def scene_of(**changes: float | str) -> Scene:
    return occ.load_preset("phone-68us").replace(
        rows=COLUMNS,
        columns=LINES,
        switching_frequency=4e3,
        readout_time=9e-6,
        exposure_time=120e-6,
        averaging="light",
        **changes,
    )


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("bits", [12, 14, 16])
def test_green_photosites_give_the_light_of_each_line(
    tmp_path: Path, pattern: str, bits: int
) -> None:
    light, black = light_of(scene_of()), 2 ** (bits - 6)
    path = write_dng(
        tmp_path / "x.dng",
        mosaic_of(light, COLUMNS, pattern, bits=bits, black=black),
        pattern,
        bits=bits,
        black=black,
    )
    photo = occ.load_photo(path)
    assert (photo.turned, photo.channel, photo.is_linear) == (True, "green", True)
    assert photo.samples.shape == (COLUMNS, LINES)
    step = 1.0 / (2**bits - 1 - black)
    assert np.abs(photo.samples / 65535 - light).max() <= 0.5 * step + 0.5 / 65535


@pytest.mark.parametrize("pattern", PATTERNS)
def test_columns_as_scan_axis_are_read_likewise(tmp_path: Path, pattern: str) -> None:
    light = light_of(scene_of())
    sideways = mosaic_of(light, COLUMNS, pattern).T
    mirrored = "".join(pattern[place] for place in (0, 2, 1, 3))
    photo = occ.load_photo(write_dng(tmp_path / "x.dng", sideways, mirrored))
    assert not photo.turned
    assert np.abs(photo.samples / 65535 - light).max() <= 1.0 / 65535


@pytest.mark.parametrize(("samples", "expected"), [(32803, True), (1, False)])
def test_the_sensors_samples_are_found_behind_a_thumbnail(
    tmp_path: Path, samples: int, expected: bool
) -> None:
    path = tmp_path / "x.nef"
    with tifffile.TiffWriter(path) as file:
        file.write(np.zeros((4, 6), np.uint8), photometric=1, subifds=1)
        file.write(np.zeros((8, 12), np.uint16), photometric=samples)
    with path.open("rb") as opened:
        assert is_raw(opened) is expected


def test_odd_sizes_keep_every_line_and_column(tmp_path: Path) -> None:
    light = light_of(scene_of())[:-1]
    photo = occ.load_photo(write_dng(tmp_path / "x.dng", mosaic_of(light, COLUMNS - 1)))
    assert photo.samples.shape == (COLUMNS - 1, LINES - 1)
    assert np.abs(photo.samples / 65535 - light).max() <= 1.0 / 65535


def test_margins_of_the_sensor_are_cut_off_with_its_pattern(tmp_path: Path) -> None:
    light = light_of(scene_of())
    # The area begins with a line of green and blue, which is how the file names its pattern.
    area = (50829, 4, 4, (1, 2, LINES, COLUMNS), True)
    mosaic = mosaic_of(light, COLUMNS, "RGGB")
    photo = occ.load_photo(write_dng(tmp_path / "x.dng", mosaic, "GBRG", more_tags=(area,)))
    first = 2  # LibRaw begins with an even line
    assert photo.samples.shape == (COLUMNS - 2, LINES - first)
    assert np.abs(photo.samples / 65535 - light[first:]).max() <= 1.0 / 65535


@pytest.mark.parametrize("orientation", range(1, 9))
def test_orientation_is_applied_as_to_any_photo(tmp_path: Path, orientation: int) -> None:
    from PIL import Image, ImageOps

    mosaic = np.zeros((40, 60), np.uint16)
    mosaic[4:12, 6:20] = 60_000  # not symmetrical
    raw = occ.load_photo(write_dng(tmp_path / "x.dng", mosaic, orientation=orientation), "columns")
    notes = Image.Exif()
    notes[0x0112] = orientation
    grey = Image.fromarray((mosaic // 257).astype(np.uint8))
    grey.save(tmp_path / "x.png", exif=notes)
    upright = ImageOps.exif_transpose(Image.open(tmp_path / "x.png"))
    assert np.array_equal(raw.samples > 0, np.asarray(upright) > 0)


def test_black_level_is_zero_and_white_level_is_saturated(tmp_path: Path) -> None:
    mosaic = np.full((40, 60), 500, np.uint16)
    mosaic[:, 20:40] = 4095
    mosaic[:, 40:] = 100  # darker than black
    photo = occ.load_photo(write_dng(tmp_path / "x.dng", mosaic, bits=12, black=500), "columns")
    assert photo.white == 65535
    assert np.array_equal(np.unique(photo.samples[:, 20:40]), [65535])
    assert not photo.samples[:, :20].any()
    assert not photo.samples[:, 40:].any()


def fractions(numbers: NDArray[np.float64]) -> tuple[int, ...]:
    return tuple(part for number in numbers for part in (round(100 * number), 100))


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("margins", [(0, 0), (2, 4)])
def test_black_levels_of_lines_and_columns_leave_no_stripes(
    tmp_path: Path, margins: tuple[int, int], turned: bool
) -> None:
    rng = np.random.default_rng(3)
    lines, columns = 60, 80
    of_lines, of_columns = rng.uniform(-20, 300, lines), rng.uniform(0, 40, columns)
    repeated = np.array([[500, 510, 520], [530, 540, 550], [500, 560, 505], [515, 525, 535]])
    black = np.tile(repeated, (lines, columns))[:lines, :columns]
    black = black + of_lines[:, None] + of_columns
    light = np.tile(rng.uniform(0, 0.8, columns if turned else lines), (lines, 1))
    light = light[:, :columns] if turned else light[:, :lines].T.repeat(2, axis=1)[:, :columns]
    mosaic = np.full((lines + margins[0], columns + margins[1]), 9, np.uint16)
    scale = 16383 - black.max()
    mosaic[margins[0] :, margins[1] :] = np.rint(black + light * scale)
    tags = (
        (50713, 3, 2, repeated.shape, True),
        (50714, 3, repeated.size, tuple(repeated.ravel().tolist()), True),
        (50715, 10, columns, fractions(of_columns), True),
        (50716, 10, lines, fractions(of_lines), True),
        (50829, 4, 4, (*margins, *mosaic.shape), True),
    )
    path = write_dng(tmp_path / "x.dng", mosaic, bits=14, black=None, more_tags=tags)
    photo = occ.load_photo(path, "columns" if turned else "lines")
    samples = photo.samples if turned else photo.samples.T
    assert np.ptp(samples.astype(int), axis=0 if turned else 1).max() <= 2 * 65535 / scale
    assert np.abs(samples / 65535 - light).max() <= 2 / scale


def test_too_few_black_levels_of_lines_are_damage(tmp_path: Path) -> None:
    mosaic = np.full((40, 60), 500, np.uint16)
    tags = ((50716, 10, 39, fractions(np.arange(39.0)), True),)
    with pytest.raises(occ.PhotoError, match="tag 50716 has too few numbers"):
        occ.load_photo(write_dng(tmp_path / "x.dng", mosaic, more_tags=tags))


def test_a_dng_in_jpeg_xl_is_named(tmp_path: Path) -> None:
    path = write_dng(tmp_path / "x.dng", np.full((40, 60), 500, np.uint16))
    overwrite(path, Compression=52546)
    with pytest.raises(occ.PhotoError, match="its samples are compressed as JPEG XL; allowed: DNG"):
        occ.load_photo(path)


def test_match_gives_the_readout_time_of_a_sensor_line(tmp_path: Path) -> None:
    scene = scene_of(code=345)
    mosaic = mosaic_of(light_of(scene), COLUMNS, bits=14, black=512, noise=0.02, seed=4)
    photo = occ.load_photo(write_dng(tmp_path / "x.dng", mosaic, bits=14, black=512))
    match = occ.match_photo(photo, scene.replace(readout_time=5e-6, gamma=2.22))
    assert match.readout_time == pytest.approx(9e-6, rel=2e-3)
    assert match.exposure_time == pytest.approx(120e-6, rel=0.02)
    assert (match.gamma, match.scene.model.averaging) == (1.0, "light")


def test_notes_are_those_of_the_files_tags(tmp_path: Path) -> None:
    mosaic = np.full((40, 60), 500, np.uint16)
    photo = occ.load_photo(write_dng(tmp_path / "x.dng", mosaic, exposure_time=(1, 8000)))
    assert photo.exposure_time == pytest.approx(1 / 8000)
    assert (photo.f_number, photo.iso, photo.camera) == (2.8, 400.0, "Simulated Camera")


@pytest.mark.parametrize("fraction", [0.02, 0.2, 0.5, 0.99])
def test_cut_files_are_refused_quietly(
    tmp_path: Path, fraction: float, capfd: pytest.CaptureFixture[str]
) -> None:
    path = write_dng(tmp_path / "x.dng", mosaic_of(light_of(scene_of()), COLUMNS))
    content = path.read_bytes()
    path.write_bytes(content[: int(fraction * len(content))])
    with pytest.raises(occ.PhotoError, match=r"x\.dng cannot be read: .*damaged"):
        occ.load_photo(path)
    assert capfd.readouterr() == ("", "")


def test_black_level_of_white_is_damage(tmp_path: Path) -> None:
    path = write_dng(tmp_path / "x.dng", np.full((40, 60), 500, np.uint16), bits=14, black=16383)
    with pytest.raises(occ.PhotoError, match="it states that black is 16383 and white 16383"):
        occ.load_photo(path)


def test_too_many_photosites_are_refused_before_decoding(tmp_path: Path) -> None:
    path = write_dng(tmp_path / "x.dng", np.full((40, 60), 500, np.uint16))
    with pytest.raises(occ.PhotoError, match="has 60 x 40 pixels, 2,400; allowed: at most 2,399"):
        occ.load_photo(path, max_pixels=2399)
    overwrite(path, ImageWidth=13_000, ImageLength=13_000)
    with pytest.raises(occ.PhotoError, match="GB of memory"):
        occ.load_photo(path)


@pytest.mark.parametrize("channel", ["red", "blue", "luma"])
def test_colours_of_every_second_line_are_refused(tmp_path: Path, channel: str) -> None:
    path = write_dng(tmp_path / "x.dng", np.full((40, 60), 500, np.uint16))
    with pytest.raises(occ.PhotoError, match=rf"The channel is {channel}"):
        occ.load_photo(path, channel=channel)


def test_missing_reader_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write_dng(tmp_path / "x.dng", np.full((40, 60), 500, np.uint16))
    monkeypatch.setitem(sys.modules, "rawpy", None)
    with pytest.raises(occ.PhotoError, match=r"pip install occ-explorer\[raw\]"):
        occ.load_photo(path)


def test_colours_that_were_interpolated_are_refused(tmp_path: Path) -> None:
    tags = [(50706, 1, 4, b"\x01\x04\x00\x00", True), (50708, 2, 0, "Simulated", True)]
    picture = np.full((40, 60, 3), 500, np.uint16)
    path = tmp_path / "x.dng"
    tifffile.imwrite(path, picture, photometric=34892, planarconfig="contig", extratags=tags)
    with pytest.raises(occ.PhotoError, match="contains interpolated colours"):
        occ.load_photo(path)


def test_reading_can_be_cancelled(tmp_path: Path) -> None:
    path = write_dng(tmp_path / "x.dng", mosaic_of(light_of(scene_of()), COLUMNS))

    def cancel(fraction: float) -> None:
        if fraction > 0.1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        occ.load_photo(path, progress=cancel)
    assert os.path.exists(path)  # noqa: PTH110

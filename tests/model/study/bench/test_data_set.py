"""The pictures of a generated data set with the published layout are found, read and measured."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from occ_model.camera.exposure import lit_fraction
from occ_model.errors import OccError
from occ_model.results.bit_errors import BenchRequest
from occ_model.study.bench.bench import bench_scene, load_pictures, read_pictures

TICK = 1e-7
FIELDS = "sample_uuid,relative_path,dims,tclk,sampling_ticks,exposure_ticks,txsymbol_ticks"


def make_data_set(folder: Path, ratios: tuple[float, ...]) -> Path:
    """Write pictures of horizontal stripes of Manchester chips, and their table."""
    (folder / "images").mkdir()
    random, lines = np.random.default_rng(1), [FIELDS]
    for number, ratio in enumerate(ratios):
        scene = bench_scene(BenchRequest(payload_bits=100), "manchester", ratio)
        bits = "".join(map(str, random.integers(0, 2, 100)))
        lit = lit_fraction(scene.replace(payload=f"bits:{bits}", columns=1080))
        # Light as a camera stores it, in rows, with noise.
        levels = 255.0 * (0.05 + 0.8 * lit) ** (1.0 / scene.camera.gamma)
        noisy = levels[:, None] + random.normal(0.0, 2.0, (1080, 40))
        picture = np.repeat(np.clip(np.rint(noisy), 0, 255).astype(np.uint8)[..., None], 3, axis=2)
        cv2.imwrite(str(folder / "images" / f"{number}.png"), picture)
        sampling = scene.camera.readout_time / TICK
        lines.append(
            f'{number:08x},images/{number}.png,"(1080, 40, 3)",{TICK},{sampling:.0f},'
            f"{5 * ratio * sampling:.0f},{5 * sampling:.0f}"
        )
    table = folder / "table.csv"
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return table


def test_pictures_and_times_are_those_of_the_table(tmp_path: Path) -> None:
    first, second = load_pictures(make_data_set(tmp_path, (1.0, 3.5)))
    assert first.path == (tmp_path / "images" / "0.png").resolve()
    assert second.symbol / second.sampling == pytest.approx(5.0)
    assert second.exposure / second.symbol == pytest.approx(3.5)


def test_the_chips_read_explain_every_picture(tmp_path: Path) -> None:
    samples = load_pictures(make_data_set(tmp_path, (1.0, 3.5, 6.0)))
    for reading in read_pictures(samples, ("sequence",)):
        assert reading.chips >= 210
        assert reading.correlation > 0.99
        assert reading.wrong_chips < 0.02


def test_progress_counts_pictures(tmp_path: Path) -> None:
    samples = load_pictures(make_data_set(tmp_path, (1.0, 2.0)))
    seen: list[tuple[int, int]] = []
    found = list(read_pictures(samples, ("threshold",), progress=lambda *now: seen.append(now)))
    assert [reading.decoder for reading in found] == ["threshold"] * 2
    assert seen == [(0, 2), (1, 2), (2, 2)]


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        (("txsymbol_ticks", "symbols"), "has no column txsymbol_ticks"),
        ((",400\n", ",none\n"), "line 2: txsymbol_ticks is 'none'"),
        ((",400\n", ",-4\n"), "line 2: txsymbol_ticks is '-4'"),
        (("images/0.png", "../0.png"), "line 2: .* is outside the folder"),
        (("images/0.png", ""), "line 2: relative_path is missing"),
        (("images/0.png", "a\0b"), r"line 2: 'a\\x00b' cannot be the name of a file"),
        (("images/0.png", "a" * 200_000), r"not a table: field larger than field limit \(131072\)"),
        ((f",{TICK},", ",1e-320,"), r"line 2: times of \[.*\] s; allowed"),
    ],
)
def test_the_refusal_of_a_table_names_the_line(
    tmp_path: Path, changed: tuple[str, str], words: str
) -> None:
    table = make_data_set(tmp_path, (1.0,))
    table.write_text(table.read_text("utf-8").replace(*changed), encoding="utf-8")
    with pytest.raises(OccError, match=words):
        load_pictures(table)


def test_a_missing_picture_is_named(tmp_path: Path) -> None:
    samples = load_pictures(make_data_set(tmp_path, (1.0,)))
    samples[0].path.unlink()
    with pytest.raises(OccError, match=r"0\.png"):
        list(read_pictures(samples, ("sequence",)))

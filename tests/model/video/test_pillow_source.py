"""An animated picture as Pillow decodes it, in this process."""

import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from occ_model.video.file.pillow_source import PillowSource

Source = Callable[[Path, str], PillowSource]


@pytest.fixture(autouse=True)
def settings_of_pillow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Put back what the process of a decoder sets for itself."""
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", Image.MAX_IMAGE_PIXELS)


@pytest.fixture
def source_of() -> Iterator[Callable[[Path, str], PillowSource]]:
    """Open sources, and close them after the test."""
    opened: list[PillowSource] = []

    def opens(path: Path, channel: str) -> PillowSource:
        with warnings.catch_warnings():
            opened.append(PillowSource(path, channel))
        return opened[-1]

    yield opens
    for source in opened:
        source.close()


@pytest.fixture
def film(tmp_path: Path) -> Path:
    """Two frames: one of each colour of its own, the other half transparent."""
    first = np.full((4, 6, 4), (200, 100, 50, 255), dtype=np.uint8)
    second = first.copy()
    second[:, 3:, 3] = 0
    second[0, 0, 3] = 128
    frames = [Image.fromarray(one) for one in (first, second)]
    path = tmp_path / "film.png"
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=[40, 60], blend=0)
    return path


@pytest.mark.parametrize(("channel", "level"), [("red", 200), ("green", 100), ("blue", 50)])
def test_each_colour_has_its_levels_and_what_is_transparent_is_black(
    film: Path, source_of: Source, channel: str, level: int
) -> None:
    source = source_of(film, channel)
    assert (source.frame_count, source.frame_rate, source.pixels) == (2, 25.0, 24)
    first, second = source.read(), source.read()
    assert (first.pixels == level).all()
    assert (second.pixels[1:, :3] == level).all()
    assert not second.pixels[:, 3:].any()
    assert second.pixels[0, 0] == round(level * 128 / 255)
    assert (first.time, second.time) == (0.0, pytest.approx(0.04))
    assert source.read() is None


def test_frames_are_passed_over_with_their_times(film: Path, source_of: Source) -> None:
    source = source_of(film, "red")
    assert source.skip()
    second = source.read()
    assert second.time == pytest.approx(0.04)
    assert not source.skip()


def test_grey_pictures_stay_as_they_are(tmp_path: Path, source_of: Source) -> None:
    grey = np.arange(24, dtype=np.uint8).reshape(4, 6)
    Image.fromarray(grey).save(tmp_path / "grey.png")
    frame = source_of(tmp_path / "grey.png", "green").read()
    assert frame.pixels.tolist() == grey.tolist()

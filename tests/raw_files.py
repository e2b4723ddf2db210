"""Write DNG files of simulated light, as a camera's sensor under a Bayer filter sees it."""

from pathlib import Path
from typing import Any

import numpy as np
import tifffile
from numpy.typing import NDArray

import occ_model as occ
from occ_model.scene.scene import Scene

PATTERNS = {
    "RGGB": b"\x00\x01\x01\x02",
    "GRBG": b"\x01\x00\x02\x01",
    "GBRG": b"\x01\x02\x00\x01",
    "BGGR": b"\x02\x01\x01\x00",
}
"""The DNG's colours of the first two photosites of the first two lines: 0 red, 1 green, 2 blue."""

_COLOUR_FILTER_ARRAY = 32803
_SENSITIVITY = np.array([0.35, 1.0, 0.5])
"""Of red, green and blue photosites to the LED's light."""


def light_of(scene: Scene, dark: float = 0.05, bright: float = 0.8) -> NDArray[np.float64]:
    """Return the light on each line of a sensor that a scene's shutter scans, 1 being white."""
    lit = occ.on_time(scene) / scene.camera.exposure_time
    return np.asarray(dark + (bright - dark) * lit)


def mosaic_of(
    light: NDArray[np.float64],
    columns: int,
    pattern: str = "RGGB",
    *,
    bits: int = 16,
    black: int = 0,
    noise: float = 0.0,
    seed: int = 1,
) -> NDArray[np.uint16]:
    """Return the samples of a sensor with a Bayer filter, shape (lines, columns)."""
    colours = np.frombuffer(PATTERNS[pattern], np.uint8).reshape(2, 2)
    lines = np.arange(len(light))[:, None] % 2
    seen = light[:, None] * _SENSITIVITY[colours[lines, np.arange(columns)[None, :] % 2]]
    seen = seen + noise * np.random.default_rng(seed).normal(size=seen.shape)
    white = 2**bits - 1
    written: NDArray[np.uint16] = (
        np.rint(black + seen * (white - black)).clip(0, white).astype("u2")
    )
    return written


def write_dng(
    path: Path,
    mosaic: NDArray[np.uint16],
    pattern: str = "RGGB",
    *,
    bits: int = 16,
    black: int | None = 0,
    orientation: int = 1,
    exposure_time: tuple[int, int] = (1, 10_000),
    more_tags: tuple[Any, ...] = (),
) -> Path:
    """Write a DNG file; samples of 12 bits are packed, others take 16 bits each."""
    tags = [
        (50706, 1, 4, b"\x01\x04\x00\x00", True),  # DNG 1.4
        (50708, 2, 0, "Simulated camera", True),
        (271, 2, 0, "Simulated", True),
        (272, 2, 0, "Camera", True),
        (274, 3, 1, orientation, True),
        (33421, 3, 2, (2, 2), True),
        (33422, 1, 4, PATTERNS[pattern], True),
        *([] if black is None else [(50714, 3, 1, black, True)]),
        (50717, 3, 1, 2**bits - 1, True),
        (33434, 5, 1, exposure_time, True),
        (33437, 5, 1, (28, 10), True),
        (34855, 3, 1, 400, True),
        *more_tags,
    ]
    stored = _pack_12_bits(mosaic) if bits == 12 else mosaic
    tifffile.imwrite(path, stored, photometric=_COLOUR_FILTER_ARRAY, extratags=tags)
    if bits == 12:
        overwrite(path, ImageWidth=mosaic.shape[1], BitsPerSample=12)
    return path


def overwrite(path: Path, **tags: int) -> None:
    """Change tags of an existing TIFF file."""
    with tifffile.TiffFile(path, mode="r+") as file:
        for name, value in tags.items():
            page = file.pages.first
            page.tags[name].overwrite(value)


def _pack_12_bits(mosaic: NDArray[np.uint16]) -> NDArray[np.uint8]:
    """Pack pairs of 12 bits into three bytes, the upper bits first."""
    first, second = mosaic[:, 0::2].astype(np.uint32), mosaic[:, 1::2].astype(np.uint32)
    both = np.stack([first >> 4, (first & 15) << 4 | second >> 8, second & 255], axis=-1)
    return both.astype(np.uint8).reshape(len(mosaic), -1)

"""Photos and RAW files, damaged or valid but unusual, and damaged films."""

from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import damage
import damaged_photos
import numpy as np
import raw_files
from films import read_damaged_films

import occ_model as occ
from hard_cases.fuzzing.target import FuzzTarget, check_sentence
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.scene.scene import Scene

_FEW_PIXELS = 100_000  # pixels of a photo up to which it is decoded too


def check_photo(photo: Photo) -> None:
    """Check types, shapes and ranges of a photo."""
    assert photo.samples.dtype in (np.uint8, np.uint16)
    assert photo.white == np.iinfo(photo.samples.dtype).max
    assert photo.image.dtype == np.uint8
    assert photo.image.shape == photo.samples.shape
    assert photo.profile.shape == photo.samples.shape[1:]
    assert np.isfinite(photo.profile).all()
    assert -1e-9 <= photo.profile.min() <= photo.profile.max() <= 255 + 1e-9
    assert photo.camera is None or photo.camera.isprintable()
    assert photo.camera is None or 0 < len(photo.camera) < 1000
    time = photo.exposure_time
    assert time is None or 0.0 < time < np.inf


def _read(random: Random, path: Path) -> list[str]:
    axis, channel = random.choice(SCAN_AXES), random.choice(CHANNELS)
    photo = load_photo(path, axis, channel=channel)
    check_photo(photo)
    if photo.image.size > _FEW_PIXELS:
        return []
    decoder = random.choice(occ.decoders())
    found = occ.decode(photo.image, Scene(), decoder)
    if found.failure is not None:
        check_sentence(found.failure)
    return []


def _read_photo(random: Random, folder: Path) -> list[str]:
    make = damaged_photos.make_damaged if random.random() < 0.8 else damaged_photos.make_unusual
    _name, content = make(random.getrandbits(32))
    path = folder / random.choice(("photo", "photo.png", "photo.jpg", "photo.dng", "ph\x1boto\n"))
    path.write_bytes(content)
    return _read(random, path)


@cache
def _raw_files() -> tuple[bytes, ...]:
    """Return a few small DNG files: packed or not, with several Bayer patterns."""
    light = np.tile(np.repeat([0.1, 0.9], 8), 4)
    files = []
    with TemporaryDirectory() as folder:
        for pattern, bits, black in (("RGGB", 16, 0), ("BGGR", 12, 256), ("GRBG", 16, 64)):
            path = Path(folder, "photo.dng")
            mosaic = raw_files.mosaic_of(light, 48, pattern, bits=bits, black=black)
            raw_files.write_dng(path, mosaic, pattern, bits=bits, black=black, orientation=6)
            files.append(path.read_bytes())
    return tuple(files)


def _read_raw(random: Random, folder: Path) -> list[str]:
    rng = np.random.default_rng(random.getrandbits(32))
    path = folder / random.choice(("photo.dng", "photo.DNG", "photo", "photo.nef", "photo.tif"))
    path.write_bytes(damage.damage_bytes(rng, random.choice(_raw_files())))
    return _read(random, path)


PHOTOS = FuzzTarget(
    "photos", "damaged photos of 26 kinds, unusual ones of 13 kinds of pixels", _read_photo,
    (occ.PhotoError,), fraction=180, memory=400,
)  # fmt: skip

RAW = FuzzTarget(
    "RAW files", "damaged DNG files", _read_raw, (occ.PhotoError,), fraction=60, memory=400
)


def _read_film(random: Random, folder: Path) -> list[str]:
    seed = random.getrandbits(32)
    return read_damaged_films(range(seed, seed + 1), folder)


FILMS = FuzzTarget(
    "films", "damaged films of 13 kinds", _read_film, (occ.VideoError,), fraction=30, patience=10.0
)

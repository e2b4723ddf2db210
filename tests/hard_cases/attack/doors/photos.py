"""Photos and RAW files: damaged in every way, or whole and odd; and films, damaged."""

from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import damage
import damaged_photos
import numpy as np
import raw_files
from films import what_damaged_films_say

import occ_model as occ
from hard_cases.attack.promise import Door, check_sentence
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.scene.scene import Scene

_FEW_PIXELS = 100_000  # pixels of a photo up to which it is decoded too


def check_photo(photo: Photo) -> None:
    """See that all of a photo that was read is of its kind."""
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


def _read(chance: Random, path: Path) -> list[str]:
    axis, channel = chance.choice(SCAN_AXES), chance.choice(CHANNELS)
    photo = load_photo(path, axis, channel=channel)
    check_photo(photo)
    if photo.image.size > _FEW_PIXELS:
        return []
    decoder = chance.choice(occ.decoders())
    found = occ.decode(photo.image, Scene(), decoder)
    if found.failure is not None:
        check_sentence(found.failure)
    return []


def _photo(chance: Random, folder: Path) -> list[str]:
    make = damaged_photos.damaged if chance.random() < 0.8 else damaged_photos.odd
    _name, content = make(chance.getrandbits(32))
    path = folder / chance.choice(("photo", "photo.png", "photo.jpg", "photo.dng", "ph\x1boto\n"))
    path.write_bytes(content)
    return _read(chance, path)


@cache
def _raw_files() -> tuple[bytes, ...]:
    """A few small DNG files: packed and not, of several orders of colours."""
    light = np.tile(np.repeat([0.1, 0.9], 8), 4)
    files = []
    with TemporaryDirectory() as folder:
        for pattern, bits, black in (("RGGB", 16, 0), ("BGGR", 12, 256), ("GRBG", 16, 64)):
            path = Path(folder, "photo.dng")
            mosaic = raw_files.mosaic_of(light, 48, pattern, bits=bits, black=black)
            raw_files.written(path, mosaic, pattern, bits=bits, black=black, orientation=6)
            files.append(path.read_bytes())
    return tuple(files)


def _raw(chance: Random, folder: Path) -> list[str]:
    rng = np.random.default_rng(chance.getrandbits(32))
    path = folder / chance.choice(("photo.dng", "photo.DNG", "photo", "photo.nef", "photo.tif"))
    path.write_bytes(damage.damaged(rng, chance.choice(_raw_files())))
    return _read(chance, path)


PHOTOS = Door(
    "photos", "damaged photos of 26 kinds, odd ones of 13 kinds of pixels", _photo,
    (occ.PhotoError,), fraction=180, memory=400,
)  # fmt: skip

RAW = Door("RAW files", "damaged DNG files", _raw, (occ.PhotoError,), fraction=60, memory=400)


def _film(chance: Random, folder: Path) -> list[str]:
    seed = chance.getrandbits(32)
    return what_damaged_films_say(range(seed, seed + 1), folder)


FILMS = Door(
    "films", "damaged films of 13 kinds", _film, (occ.VideoError,), fraction=30, patience=10.0
)

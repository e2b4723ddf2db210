"""Pictures without the stripes of an LED, many of them striped all the same.

Each kind draws light between 0 and 1, of shape (rows, columns); a common chain then turns, shades,
blurs, rounds and compresses it as a camera does.
"""

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import skimage.data
from simulated_photos import photo_of

import occ_model as occ
from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.reading.load import stripes_are_lines
from photo_world.photograph import compress

Random = np.random.Generator

_BUNDLED = (
    "brick.png", "grass.png", "gravel.png", "text.png", "page.png", "coins.png", "camera.png",
    "moon.png", "chessboard_GRAY.png", "clock_motion.png", "coffee.png", "astronaut.png",
    "chelsea.png", "rocket.jpg", "hubble_deep_field.jpg", "retina.jpg", "ihc.png", "cell.png",
    "motorcycle_left.png", "horse.png", "color.png", "logo.png", "phantom.png",
)  # fmt: skip
"""Pictures that scikit-image brings along; it would download its other ones."""


def bundled(random: Random) -> FloatArray:
    """Cut a part out of a photograph or drawing."""
    path = Path(skimage.data.__file__).parent / str(random.choice(_BUNDLED))
    picture = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    assert picture is not None
    rows, columns = picture.shape
    height, width = int(rows * random.uniform(0.4, 1.0)), int(columns * random.uniform(0.4, 1.0))
    top, left = random.integers(0, rows - height + 1), random.integers(0, columns - width + 1)
    part = picture[top : top + height, left : left + width]
    factor = random.uniform(0.8, 2.5)
    part = cv2.resize(part, None, fx=factor, fy=factor, interpolation=cv2.INTER_CUBIC)
    return part.astype(np.float64) / 255.0


def _size(random: Random) -> tuple[int, int]:
    return int(random.integers(240, 700)), int(random.integers(400, 1400))


def _columns(values: FloatArray, rows: int) -> FloatArray:
    return np.repeat(np.asarray(values, dtype=np.float64)[None, :], rows, axis=0)


def _smooth_noise(random: Random, count: int, width: float) -> FloatArray:
    noise = random.standard_normal((1, count))
    smooth = cv2.GaussianBlur(noise, (0, 0), max(width, 0.3))[0]
    return np.asarray(smooth / max(float(smooth.std()), 1e-9))


def blinds(random: Random) -> FloatArray:
    """Draw lamellas with light between them, shaded across each."""
    rows, columns = _size(random)
    pitch, open_fraction = random.uniform(8.0, 60.0), random.uniform(0.1, 0.6)
    place = np.arange(columns) / pitch + random.uniform()
    within = place % 1.0
    slat = 0.15 + 0.3 * random.uniform() * np.sin(np.pi * within)
    light = np.where(within < open_fraction, 1.0, slat)
    return _columns(cv2.GaussianBlur(light[None], (0, 0), random.uniform(0.3, 3.0))[0], rows)


def slats(random: Random) -> FloatArray:
    """Draw boards of about equal widths and differing brightness, with dark gaps."""
    rows, columns = _size(random)
    pitch = random.uniform(12.0, 80.0)
    light = np.zeros(columns)
    edge = 0.0
    while edge < columns:
        width = pitch * (1.0 + random.uniform(0.0, 0.15) * random.standard_normal())
        first, last = int(edge), int(edge + max(width, 4.0))
        light[first:last] = random.uniform(0.4, 0.9)
        light[last - max(1, int(0.1 * pitch)) : last] = 0.1
        edge += max(width, 4.0)
    grain = 0.05 * random.standard_normal((rows, columns))
    return _columns(light, rows) + cv2.GaussianBlur(grain, (0, 0), 3.0)


def fence(random: Random) -> FloatArray:
    """Draw posts before a background of hills and sky."""
    rows, columns = _size(random)
    pitch, fraction = random.uniform(15.0, 70.0), random.uniform(0.3, 0.7)
    posts = (np.arange(columns) / pitch + random.uniform()) % 1.0 < fraction
    hills = rows * (0.5 + 0.1 * _smooth_noise(random, columns, columns / 10))
    ground = np.where(np.arange(rows)[:, None] > hills[None, :], 0.3, 0.8)
    post = random.choice([0.1, 0.95])
    top = int(rows * random.uniform(0.0, 0.3))
    picture = ground.copy()
    picture[top:, posts] = post
    return picture


def moire(random: Random) -> FloatArray:
    """Lay two gratings of nearly equal pitch over each other."""
    rows, columns = _size(random)
    place, down = np.arange(columns)[None, :], np.arange(rows)[:, None]
    pitch = random.uniform(3.0, 9.0)
    other = pitch * random.uniform(1.03, 1.3)
    tilt = random.uniform(-0.1, 0.1) * random.integers(0, 2)
    one = 0.5 + 0.5 * np.sign(np.cos(2 * np.pi * place / pitch))
    two = 0.5 + 0.5 * np.sign(np.cos(2 * np.pi * (place + tilt * down) / other))
    return np.asarray(cv2.GaussianBlur(one * two, (0, 0), random.uniform(0.5, 3.0)), np.float64)


def led_matrix(random: Random) -> FloatArray:
    """Draw a grid of round lamps, some of them off."""
    rows, columns = _size(random)
    pitch, radius = random.uniform(10.0, 50.0), random.uniform(0.15, 0.45)
    across = np.arange(columns) / pitch + random.uniform()
    down = np.arange(rows) / pitch + random.uniform()
    distance = np.hypot((across % 1.0 - 0.5)[None, :], (down % 1.0 - 0.5)[:, None])
    lamps = random.uniform(size=(int(rows / pitch) + 2, int(columns / pitch) + 2))
    on = lamps < random.choice([0.5, 0.9, 1.1])
    lit = on[down.astype(int)[:, None], across.astype(int)[None, :]]
    return np.where((distance < radius) & lit, 1.0, 0.03)


def document(random: Random) -> FloatArray:
    """Print lines of letters on paper."""
    rows, columns = _size(random)
    page = np.full((rows, columns), 245, dtype=np.uint8)
    size = random.uniform(0.4, 1.2)
    pitch, text = int(38 * size) + 4, "the quick brown fox jumps over lazy dogs 0123456789"
    margin = int(random.uniform(0.0, 0.1) * columns)
    for line in range(pitch, rows, pitch):
        letters = "".join(random.choice(list(text), int((columns - 2 * margin) / (18 * size))))
        cv2.putText(
            page, letters, (margin, line), cv2.FONT_HERSHEY_SIMPLEX, size, 20, 1 + (size > 0.7)
        )
    return page / 255.0


def table(random: Random) -> FloatArray:
    """Draw a table or a bar code: lines at uneven distances."""
    rows, columns = _size(random)
    light = np.ones(columns)
    unit = random.uniform(3.0, 12.0)
    edge = 0.0
    while edge < columns:
        bar, gap = random.integers(1, 4) * unit, random.integers(1, 4) * unit
        light[int(edge) : int(edge + bar)] = 0.05
        edge += bar + gap
    picture = _columns(light, rows)
    picture[: int(rows * random.uniform(0.0, 0.2))] = 1.0
    return picture


def banding(random: Random) -> FloatArray:
    """Draw a gradient in few steps, as a bad screen or file shows it."""
    rows, columns = _size(random)
    place = np.linspace(0.0, random.uniform(0.5, 1.0), columns)
    if random.integers(0, 2):
        place = np.hypot(place[None, :], np.linspace(0.0, 0.3, rows)[:, None])
    else:
        place = _columns(place, rows)
    steps = random.integers(4, 40)
    return np.floor(place * steps) / steps


def screen(random: Random) -> FloatArray:
    """Photograph a display: its lines, its picture elements, windows on it."""
    rows, columns = _size(random)
    picture = np.full((rows, columns), 0.7)
    for _ in range(random.integers(2, 9)):
        top, left = random.integers(0, rows - 20), random.integers(0, columns - 20)
        height, width = random.integers(15, rows), random.integers(15, columns)
        picture[top : top + height, left : left + width] = random.uniform(0.1, 1.0)
    pitch = random.uniform(2.5, 9.0)
    grid = 0.6 + 0.4 * np.cos(2 * np.pi * np.arange(columns) / pitch)
    lines = 0.8 + 0.2 * np.cos(2 * np.pi * np.arange(rows) / pitch)
    return np.asarray(picture * grid[None, :] * lines[:, None])


def stairs(random: Random) -> FloatArray:
    """Draw steps that shrink with their distance."""
    rows, columns = _size(random)
    shrink = random.uniform(1.0, 4.0)
    place = np.linspace(1.0, shrink, columns) ** 2
    phase = place * random.uniform(8.0, 40.0) / (shrink**2 if shrink > 1.2 else 1.0)
    return _columns(np.where(phase % 1.0 < random.uniform(0.3, 0.7), 0.85, 0.25), rows)


def keyboard(random: Random) -> FloatArray:
    """Draw rows of keys, each row set off against the other."""
    rows, columns = _size(random)
    pitch, gap = random.uniform(25.0, 90.0), random.uniform(0.05, 0.25)
    down = np.arange(rows) / pitch
    shift = 0.5 * (down.astype(int) % 2) * random.integers(0, 2)
    across = np.arange(columns)[None, :] / pitch + shift[:, None]
    return np.where((across % 1.0 < 1.0 - gap) & (down % 1.0 < 1.0 - gap)[:, None], 0.8, 0.1)


def waves(random: Random) -> FloatArray:
    """Draw corrugated metal or a cloth's folds: smooth ripples, some of them uneven."""
    rows, columns = _size(random)
    pitch = random.uniform(10.0, 120.0)
    drift = _smooth_noise(random, columns, 2.0 * pitch) * random.uniform(0.0, 1.5)
    ripple = np.cos(2 * np.pi * np.arange(columns) / pitch + drift)
    second = random.uniform(0.0, 0.6) * np.cos(4 * np.pi * np.arange(columns) / pitch + drift)
    return _columns(0.5 + 0.3 * (ripple + second), rows)


def ruler(random: Random) -> FloatArray:
    """Draw marks of two or three lengths: a scale, a comb, piano keys."""
    rows, columns = _size(random)
    unit, every = random.uniform(8.0, 25.0), int(random.integers(2, 11))
    place = np.arange(columns) / unit + random.uniform(0, every)
    mark = place % 1.0 < random.uniform(0.15, 0.5)
    long = (place.astype(int) % every) == 0
    reach = np.where(long, random.uniform(0.6, 1.0), random.uniform(0.2, 0.6)) * rows
    return np.where(mark[None, :] & (np.arange(rows)[:, None] < reach[None, :]), 0.1, 0.9)


def noise(random: Random) -> FloatArray:
    """Draw noise whose columns are alike, as of a damaged sensor."""
    rows, columns = _size(random)
    lines = _smooth_noise(random, columns, random.uniform(0.3, 12.0))
    return 0.5 + 0.15 * _columns(lines, rows) + 0.05 * random.standard_normal((rows, columns))


KINDS: tuple[Callable[[Random], FloatArray], ...] = (
    bundled, blinds, slats, fence, moire, led_matrix, document, table, bundled, banding, screen,
    stairs, keyboard, waves, ruler, noise, bundled,
)  # fmt: skip
"""What the pictures show, in turn."""


def negative(seed: int) -> tuple[str, occ.Photo]:
    """Make a picture without the stripes of an LED: what it shows, and the picture."""
    random = np.random.default_rng((911, seed))
    kind = KINDS[seed % len(KINDS)]
    return kind.__name__, as_loaded(photographed(kind(random), random))


def as_loaded(image: ByteArray) -> occ.Photo:
    """Turn a picture as a file's is, by its stripes."""
    return photo_of(np.ascontiguousarray(image.T) if stripes_are_lines(image, False) else image)


def photographed(light: FloatArray, random: Random) -> ByteArray:
    """Turn, shade, blur, expose and compress a picture."""
    rows, columns = light.shape
    angle = float(
        random.choice([0.0, 0.0, random.normal(0.0, 0.5), random.uniform(-8.0, 8.0), 90.0])
    )
    turn = cv2.getRotationMatrix2D((columns / 2, rows / 2), angle, 1.0)
    turned = cv2.warpAffine(light, turn, (columns, rows), borderMode=cv2.BORDER_REFLECT)
    across, down = np.linspace(-1, 1, columns), np.linspace(-1, 1, rows)
    shade = 1.0 - random.uniform(0.0, 0.3) * (across[None, :] ** 2 + down[:, None] ** 2)
    shade += random.uniform(-0.2, 0.2) * across[None, :]
    light = np.clip(turned, 0.0, None) * shade * random.uniform(0.4, 1.4)
    seen = cv2.GaussianBlur(light, (0, 0), random.uniform(0.2, 2.0))
    values = 255.0 * np.clip(seen, 0.0, 1.0) ** random.uniform(0.6, 1.1)
    values += random.uniform(0.0, 6.0) * random.standard_normal(values.shape)
    image = np.clip(np.rint(values), 0, 255).astype(np.uint8)
    quality = int(random.integers(50, 96))
    return compress(image, quality)

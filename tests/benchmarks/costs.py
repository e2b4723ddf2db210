"""What films, a match, rooms and sweeps cost, beside a single picture: rows of ``report.py``."""

import subprocess
import sys
from collections.abc import Callable
from functools import cache
from itertools import count, islice
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

import cv2

import occ_model as occ
from occ_model.files.writing import write_image
from occ_model.results.sweep_request import SignalPath
from occ_model.room.room import Place, Room, RoomLamp
from occ_model.scene.scene import Scene
from occ_model.study.paper_grid import DISTANCES, FREQUENCIES, IMAGES

_RUN, _RUNS = 8, 7
"""Frames decoded in a row: a single one would be decoded ahead, while another thing is timed."""

ROWS: dict[Callable[[], str], tuple[str, str]] = {}
"""What measures a row, and returns what it found; what that is, and what is wanted."""


def row(what: str, wanted: str = "") -> Callable[[Callable[[], str]], Callable[[], str]]:
    """Add a function that measures to the rows."""

    def add(measure: Callable[[], str]) -> Callable[[], str]:
        ROWS[measure] = what, wanted
        return measure

    return add


def side_by_side(*things: Callable[[], object], rounds: int = 41) -> list[float]:
    """Time things in turn, round after round; return the median milliseconds of each."""
    times: list[list[float]] = [[] for _ in things]
    for thing in things:
        thing()
    for _ in range(rounds):
        for thing, seconds in zip(things, times, strict=True):
            start = perf_counter()
            thing()
            seconds.append(perf_counter() - start)
    return [1e3 * median(seconds) for seconds in times]


def ratio(work: Callable[[], object], other: Callable[[], object], rounds: int = 41) -> str:
    a, b = side_by_side(work, other, rounds=rounds)
    return f"{a / b:.2f} ({a:.3g} ms)"


def peak_memory(*arguments: str) -> list[float]:
    """Return what ``memory.py`` prints."""
    command = [sys.executable, str(Path(__file__).with_name("memory.py")), *arguments]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    return [float(number) for number in ran.stdout.split()]


def film_scene() -> Scene:
    """A film's usual size: 1080 lines that are read out, 1920 pixels each."""
    return occ.load_preset("phone-136us").replace(rows=1920, columns=1080, readout_time=25e-6)


@row("a frame of a simulated film of 1920 x 1080 against one picture", "about 1")
def compare_simulated_frame() -> str:
    scene, number, start = film_scene(), count(), count()
    film = occ.render_video(scene)
    return ratio(
        lambda: film.frame(next(number)),
        lambda: occ.render(scene.replace(start_time=1e-7 * next(start))).camera_image,
        rounds=21,
    )


@row("the next frame of an MP4 film of that size against opening a JPEG photo")
def compare_decoded_frame() -> str:
    with TemporaryDirectory() as folder:
        film, photo = Path(folder, "film.mp4"), Path(folder, "photo.jpg")
        count_of_frames = _RUN * (_RUNS + 2)
        made = occ.render_video(film_scene(), count_of_frames, settings=occ.SimulationSettings())
        occ.write_video(made, film)
        write_image(photo, made.frame(0).image)
        opened = occ.load_video(film)
        frames = iter(opened)
        run, picture, opening = side_by_side(
            lambda: list(islice(frames, _RUN)),
            lambda: occ.load_photo(photo),
            lambda: occ.load_video(film),
            rounds=_RUNS,
        )
    frame = run / _RUN
    return f"{frame / picture:.2f} ({frame:.1f} ms; opening a film {opening:.0f} ms)"


@row("the most memory after 10,000 frames against after 1,000, simulated; decoded", "at most 1.02")
def compare_film_memory() -> str:
    return "; ".join(f"{growth:.3f}" for growth in peak_memory("growth"))


@cache
def _photo() -> tuple[occ.Photo, Scene]:
    """Take a photo of 12 million pixels, and say what is known of it."""
    scene = occ.load_preset("phone-136us-real").replace(
        rows=3024, columns=4032, switching_frequency=6e3, enhancement="none"
    )
    image = occ.render(scene, tolerance=0.0).image
    photo = occ.Photo(
        path=Path("simulated.png"), samples=image, white=255, image=image,
        profile=image.mean(axis=0), turned=False, channel="grey",
    )  # fmt: skip
    return photo, scene.replace(readout_time=1e-6, exposure_time=1e-3)


@row("matching a photo of 12 million pixels, against one mean of its columns", "under 1 s")
def compare_match() -> str:
    photo, scene = _photo()
    a, b, stripes = side_by_side(
        lambda: occ.match_photo(photo, scene),
        lambda: cv2.reduce(photo.image, 0, cv2.REDUCE_AVG, dtype=cv2.CV_32F),
        lambda: occ.find_stripes(photo),
        rounds=5,
    )
    return f"{a / b:.0f} ({a:.0f} ms; finding its stripes {stripes:.0f} ms)"


@row(
    "the same with another code in the scene, so that its chips are read, against known chips",
    "under 1 s",
)
def compare_match_of_unknown_chips() -> str:
    photo, scene = _photo()
    other = scene.replace(code=(scene.transmitter.code + 1) % 1024)
    return ratio(
        lambda: occ.match_photo(photo, other), lambda: occ.match_photo(photo, scene), rounds=5
    )


@row("a picture of sixteen lamps against one lamp of the same area")
def compare_many_lamps() -> str:
    def room(side: int) -> Room:
        size, gap = 0.8 / side, 0.08
        scene = occ.load_preset("phone-136us")
        sent = scene.transmitter.replace(panel_width=size, panel_height=size)
        lamps = tuple(
            RoomLamp(
                name=f"L{n}", z=1.5, start_time=1e-4 * n, transmitter=sent.replace(code=n),
                x=(size + gap) * (n % side - (side - 1) / 2),
                y=(size + gap) * (n // side - (side - 1) / 2),
            )
            for n in range(side * side)
        )  # fmt: skip
        return Room(lamps=lamps, scene=scene)

    one, many, moved = room(1), room(4), count()
    # The camera a little elsewhere each time, so that nothing is remembered.
    return ratio(
        lambda: occ.render_room(many.replace(camera=Place(x=1e-3 * next(moved)))),
        lambda: occ.render_room(one.replace(camera=Place(x=1e-3 * next(moved)))),
        rounds=5,
    )


@row("two points of Fig. 5's grid by whole pictures against the same by profiles")
def compare_sweep() -> str:
    scene, seeds = occ.load_preset("phone-136us"), count()
    axes = {"switching_frequency": FREQUENCIES[4:5], "distance": DISTANCES[::4]}

    def sweep(path: SignalPath) -> occ.SweepTable:
        # With other seeds each time, so that nothing is remembered.
        return occ.sweep(scene, axes, IMAGES, ("threshold", "matched"), next(seeds), path=path)

    a, b = side_by_side(lambda: sweep("image"), lambda: sweep("profile"), rounds=3)
    return f"{a / b:.0f} ({a:.0f} ms, {b:.0f} ms)"

"""What films cost: a frame simulated and a frame decoded against a single picture, and memory."""

import subprocess
import sys
from itertools import count, islice
from pathlib import Path
from tempfile import TemporaryDirectory

from measuring import Row, side_by_side

import occ_model as occ
from occ_model.files.writing import write_image

_GROWTH = Path(__file__).with_name("film_growth.py")
_ROUNDS = 21

_RUN, _RUNS = 8, 7
"""Frames decoded in a row: a single one would be decoded ahead, while another thing is timed."""


def film_scene() -> occ.Scene:
    """A film's usual size: 1080 lines that are read out, 1920 pixels each."""
    return occ.load_preset("phone-136us").replace(rows=1920, columns=1080, readout_time=25e-6)


def film_frame_cost() -> Row:
    """Compare a frame of a simulated film with a picture of the same scene."""
    scene, number, start = film_scene(), count(), count()
    film = occ.render_video(scene)
    frame, picture = side_by_side(
        lambda: film.frame(next(number)),
        lambda: occ.render(scene.replace(start_time=1e-7 * next(start))).camera_image,
        rounds=_ROUNDS,
    )
    return Row(
        "a frame of a simulated film of 1920 x 1080 against one picture",
        f"{frame / picture:.2f} ({1e3 * frame:.0f} ms)",
        "about 1",
    )


def film_decoding_cost() -> Row:
    """Compare the next frame of a film with opening a picture of its size, noise and all."""
    with TemporaryDirectory() as folder:
        film, photo = Path(folder, "film.mp4"), Path(folder, "photo.jpg")
        count_of_frames = _RUN * (_RUNS + 2)
        made = occ.render_video(
            film_scene(), count_of_frames, settings=occ.SimulationSettings(noise="reused")
        )
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
    return Row(
        "the next frame of an MP4 film of that size against opening a JPEG photo",
        f"{frame / picture:.2f} ({1e3 * frame:.1f} ms; opening a film {1e3 * opening:.0f} ms)",
        "",
    )


def film_memory() -> Row:
    """Compare the most memory after 10,000 frames with that after 1,000, simulated and decoded."""
    ran = subprocess.run([sys.executable, str(_GROWTH)], capture_output=True, text=True, check=True)
    simulated, decoded = map(float, ran.stdout.split())
    return Row(
        "the most memory after 10,000 frames against after 1,000, simulated; decoded",
        f"{simulated:.3f}; {decoded:.3f}",
        "at most 1.02",
    )

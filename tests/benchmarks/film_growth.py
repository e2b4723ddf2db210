"""Prints how much the peak memory grows from 1,000 frames to 10,000, simulated and decoded (Linux).

Each is a ratio of bytes; the decoder's own process is counted too.
"""

from collections.abc import Iterable
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory

from film_memory import most_bytes

import occ_model as occ

_FEW, _MANY = 1_000, 10_000


def growth(frames: Iterable[object]) -> float:
    """Go through the frames; compare the most bytes at their end with those early on."""
    run = iter(frames)
    for _ in islice(run, _FEW):
        pass
    early = most_bytes()
    for _ in islice(run, _MANY - _FEW):
        pass
    return most_bytes() / early


scene = occ.load_preset("phone-136us").replace(rows=240, columns=320, readout_time=25e-6)
settings = occ.SimulationSettings(noise="reused")
simulated = growth(occ.render_video(scene, _MANY, settings=settings))
with TemporaryDirectory() as folder:
    path = Path(folder, "film.mp4")
    occ.write_video(occ.render_video(scene, _MANY, settings=settings), path)
    decoded = growth(occ.load_video(path))
print(simulated, decoded)

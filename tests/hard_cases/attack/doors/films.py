"""Films of every container and codec, damaged."""

from pathlib import Path
from random import Random

from films import what_damaged_films_say

import occ_model as occ
from hard_cases.attack.promise import Door


def _film(chance: Random, folder: Path) -> list[str]:
    seed = chance.getrandbits(32)
    return what_damaged_films_say(range(seed, seed + 1), folder)


FILMS = Door(
    "films", "damaged films of 13 kinds", _film, (occ.VideoError,), share=30, patience=10.0
)

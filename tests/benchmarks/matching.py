"""How surely photos are explained: ``python tests/benchmarks/matching.py [what] [count] [first]``.

``--full`` does all of these in turn, with as many photos as stand here; ``first`` is the seed to
begin with. ``coverage``: how well stated errors hold, on 600 photos of a world that is wider than
the model; with ``--world lamps`` of single lamps as they are found in rooms, with ``--world
foreign`` of a camera with other optics and tone curves. ``negatives``: 400 pictures without stripes
of an LED. ``others``: 200 photos of another code than the scene's. ``unknown``: 300 photos of
unknown chips, 1.5 to 20 periods in view, half of them saturated.
``known`` (the default): 500 simulated photos with noise, vignetting, blur and JPEG of quality 60 to
95, of 4 to 30 columns a chip and exposures of a tenth of a chip to three.
``--plot FILE`` draws the errors of ``coverage`` beside their Cramer-Rao bounds.
"""

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from tqdm import tqdm

sys.path.insert(0, str(Path(__file__).parents[1]))

from photo_world.trials import WORLDS
from round_trips import Found, round_trips
from stated_errors import plot, told
from verdicts import Said, said_of, said_of_negative, said_of_other_code, said_of_unknown_chips


def line(what: str, errors: list[float], allowed: float) -> str:
    """Say how large errors are in the median, and how many are within the limit."""
    within = 100.0 * np.mean(np.array(errors) < allowed)
    return (
        f"{what}: median {100.0 * float(np.median(errors)):.2g} %, within {100.0 * allowed:g} %: "
        f"{within:.1f} % of {len(errors)}"
    )


def report(found: list[Found]) -> list[str]:
    """Say how exactly the photos were explained."""
    long = [one for one in found if one.exposure_in_chips > 0.5]
    short = [one for one in found if one.exposure_in_chips <= 0.5]
    lines = [
        line("readout time", [one.readout for one in found], 0.002),
        line("exposure of more than half a chip", [one.exposure for one in long], 0.05),
        line("exposure of less", [one.exposure for one in short], 0.05),
    ]
    sure = [one.readout for one in found if one.is_sure]
    lines.append(f"sure: {len(sure)} of {len(found)} ({100.0 * len(sure) / len(found):.1f} %)")
    if sure:
        lines.append(line("readout time of what is sure", sure, 0.002))
    lines += [
        f"  doubtful, photo {one.seed}: {' '.join(one.doubts)}" for one in found if one.doubts
    ]
    failures = [one for one in found if one.failure]
    lines.append(f"not explained: {len(failures)}")
    lines += [f"  photo {one.seed}: {one.failure}" for one in failures]
    return lines


def tally(said: list[Said]) -> list[str]:
    """Count the verdicts, and quote those that are not a refusal or not right."""
    count = len(said)
    lines = []
    for verdict in ("sure", "doubtful", "refused"):
        these = [one for one in said if one.verdict == verdict]
        right = sum(one.right for one in these)
        scene_s = sum(one.scene_s for one in these)
        lines.append(
            f"{verdict}: {len(these)} of {count} ({100.0 * len(these) / count:.1f} %), {right} of "
            f"them with the chips sent, {scene_s} with the scene's"
        )
    wrong = [one for one in said if not one.right and one.verdict != "refused"]
    missed = [one for one in said if one.what != "other code" and one.verdict == "refused"]
    quoted = wrong + (missed if any(one.right for one in said) else [])
    return lines + [f"  {one.what} {one.seed}: {one.verdict}. {one.why}" for one in quoted]


WHAT: dict[str, tuple[int, Callable[[Sequence[int]], Iterator[Any]], Callable[..., list[str]]]] = {
    "coverage": (600, WORLDS["wide"], told),
    "negatives": (400, partial(said_of, said_of_negative), tally),
    "others": (200, partial(said_of, said_of_other_code), tally),
    "unknown": (300, partial(said_of, said_of_unknown_chips), tally),
    "known": (500, round_trips, report),
}
"""The full number of photographs, how they are matched, and how the result is written."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", nargs="?", choices=list(WHAT), default="known")
    parser.add_argument("count", nargs="?", type=int, help="number of photographs")
    parser.add_argument("first", nargs="?", type=int, default=0, help="seed to begin with")
    parser.add_argument("--full", action="store_true", help="everything, as many as are asked for")
    parser.add_argument("--world", choices=list(WORLDS), default="wide", help="of coverage")
    parser.add_argument("--plot", type=Path, help="picture of the errors of coverage")
    words = parser.parse_args()
    for what in WHAT if words.full else [words.what]:
        most, match, tell = WHAT[what]
        if what == "coverage":
            match = WORLDS[words.world]
        count = most if words.full or words.count is None else words.count
        found = match(range(words.first, words.first + count))
        results = list(tqdm(found, what, count))
        seeds = f"{what}, seeds {words.first} to {words.first + count - 1}"
        print("\n".join([seeds, *tell(results)]), flush=True)
        if what == "coverage" and words.plot:
            plot(results, words.plot)


if __name__ == "__main__":
    main()

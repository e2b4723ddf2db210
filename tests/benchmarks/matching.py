"""How surely photos are explained: ``python tests/benchmarks/matching.py [what] [count] [first]``.

``known`` (the default): 500 simulated photos (or as many as named) with noise, vignetting, blur and
JPEG of quality 60 to 95, of 4 to 30 columns a chip and exposures of a tenth of a chip to three.
``negatives``: 400 pictures without stripes of an LED. ``others``: 200 photos of another code than
the scene's. ``unknown``: 300 photos of unknown chips, 1.5 to 20 periods in view, half of them
saturated. ``first`` is the seed to begin with.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from round_trips import Found, round_trips
from verdicts import Said, said_of, said_of_negative, said_of_other_code, said_of_unknown_chips


def line(what: str, errors: list[float], allowed: float) -> str:
    """Say how large errors are in the median, and how many are within what is allowed."""
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


TABLES = {
    "negatives": (said_of_negative, 400),
    "others": (said_of_other_code, 200),
    "unknown": (said_of_unknown_chips, 300),
}

if __name__ == "__main__":
    words = sys.argv[1:]
    what = words.pop(0) if words and not words[0].isdigit() else "known"
    count = int(words.pop(0)) if words else (500 if what == "known" else TABLES[what][1])
    first = int(words.pop(0)) if words else 0
    seeds = range(first, first + count)
    if what == "known":
        print("\n".join(report(round_trips(seeds))))
    else:
        print("\n".join(tally(said_of(TABLES[what][0], seeds))))

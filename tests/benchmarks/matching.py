"""How exactly photos of known scenes are explained: ``python tests/benchmarks/matching.py``.

500 simulated photos (or as many as named) with noise, vignetting, blur and JPEG of quality 60 to
95, of 4 to 30 columns a chip and exposures of a tenth of a chip to three chips.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from round_trips import Found, round_trips


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


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    print("\n".join(report(round_trips(range(count)))))

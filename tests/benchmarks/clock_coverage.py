"""Do the stated errors of films' clocks hold? For each container, and for what is known.

python tests/benchmarks/clock_coverage.py 600      # films of each kind: about half an hour
python tests/benchmarks/clock_coverage.py 200 GIF AVI    # these containers alone
"""

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from film_clocks import KNOWN, RESOLUTIONS, judge_clocks

NAMES = ("switching_frequency", "readout_time", "gap", "frame_period")


def main(count: int, containers: Sequence[str]) -> None:
    for container in containers or RESOLUTIONS:
        for known in KNOWN:
            judged = list(judge_clocks(container, known, count))
            found = [one for one in judged if one.clock.fits]
            sure = [one for one in found if one.is_sure]
            listed = sum(one.is_listed for one in found)
            parts = [
                f"{container:9}{known:8} {len(found)} of {count} clocks, "
                f"{listed} hold the true one, {len(sure)} sure;"
            ]
            for name in NAMES:
                off = np.abs([one.off(name) for one in sure])
                shares = [f"{100.0 * np.mean(off < bound):.1f}" for bound in (1.0, 2.0, 4.0)]
                parts.append(f"{name} {' / '.join(shares)} %, at most {off.max():.1f};")
            print(" ".join(parts), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])

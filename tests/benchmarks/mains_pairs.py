"""What is measured of cameras by bars of mains lamps, beside what is known.

    python tests/benchmarks/mains_pairs.py FOLDER
    python tests/benchmarks/mains_pairs.py --simulated 200 --first 1000
    python tests/benchmarks/mains_pairs.py --without-bars 100 --first 5000

FOLDER has a ``truths.csv`` with the columns files (one or two, with a space between), mains_hz,
least_ms and most_ms (of the frame's readout; empty if it is not known) and scan. Without it the
pictures ``x_1`` and ``x_2``, or ``x_in`` and ``x_ref``, are pairs at ``--mains``. Printed are the
verdict, the value and its error beside what is known; of simulated pairs the share of the sure ones
within one and two stated errors, and the largest error. Nothing of the pictures is kept.
"""

import argparse
import sys
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from photo_world.mains_pairs import Measured, measure_room, measure_truth, truths
from photo_world.mains_rooms import random_room


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--mains", type=float, default=50.0)
    parser.add_argument("--simulated", type=int, default=0)
    parser.add_argument("--without-bars", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    if options.folder is not None:
        for truth in truths(options.folder, options.mains):
            start = time.process_time()
            measured = measure_truth(truth)
            spent = time.process_time() - start
            print(f"{truth.name:34}{measured.line()}  known {truth.known:14} {spent:.1f} s")
    print_simulated(options.first, options.simulated, has_bars=True)
    print_simulated(options.first, options.without_bars, has_bars=False)


def print_simulated(first: int, count: int, *, has_bars: bool) -> None:
    found: list[tuple[Measured, float]] = []
    for seed in range(first, first + count):
        room = random_room(seed, has_bars=has_bars)
        measured = measure_room(room)
        found.append((measured, room.frame_readout))
        print(f"{seed:5} {room.bars:6.2f} bars  {measured.line(room.frame_readout)}", flush=True)
    if found:
        print(dict(Counter(measured.verdict for measured, _ in found)))
        print_errors([pair for pair in found if pair[0].verdict == "sure"])


def print_errors(sure: list[tuple[Measured, float]]) -> None:
    off = [abs(measured.off(truth)) for measured, truth in sure]
    relative = [abs(measured.value / truth - 1.0) for measured, truth in sure]
    if off:
        shares = [100.0 * sum(each <= limit for each in off) / len(off) for limit in (1.0, 2.0)]
        print(f"sure: within 1 and 2 errors {shares[0]:.0f} and {shares[1]:.0f} %")
        print(f"largest error {100.0 * max(relative):.2f} %, {max(off):.1f} stated errors")
        print(f"wrong by 3 %: {sum(each > 0.03 for each in relative)} of {len(off)}")


if __name__ == "__main__":
    main()

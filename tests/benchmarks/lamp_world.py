"""What is said of simulated lamps and of other regular things, and whether stated errors hold.

    python tests/benchmarks/lamp_world.py lamps 200 1000
    python tests/benchmarks/lamp_world.py others 100 1000
    python tests/benchmarks/lamp_world.py blinds 20 1000

The numbers are how many pictures, and the first seed. Thresholds may be set on seeds below 5000;
those from 9000 judge. *blinds* are upright and have black gaps: no single picture tells them from a
lamp.
"""

import argparse
import sys
from collections import Counter, defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from both_cores import on_both_cores
from photo_world.lamp_trials import lamp_trial, report
from photo_world.regular_things import verdict_on, verdict_on_black_blinds

OTHERS = {"others": verdict_on, "blinds": verdict_on_black_blinds}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("lamps", *OTHERS))
    parser.add_argument("count", type=int)
    parser.add_argument("first", type=int)
    asked = parser.parse_args()
    seeds = range(asked.first, asked.first + asked.count)
    if asked.what == "lamps":
        print("\n".join(report(list(on_both_cores(lamp_trial, seeds)))))
        return
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for kind, verdict in on_both_cores(OTHERS[asked.what], seeds):
        counts[kind][verdict] += 1
    for kind, count in counts.items():
        print(f"{kind:20} {dict(count)}")
    print(sum(counts.values(), Counter()))


if __name__ == "__main__":
    main()

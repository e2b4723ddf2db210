"""How well simulated films are read: errors of the clock and payloads, with all packets counted.

python tests/benchmarks/film_reading.py            # all 40 films: about ten minutes
python tests/benchmarks/film_reading.py 8          # the first 8
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from simulated_films import FILMS, film, judge


def main(first: int, count: int) -> None:
    ratios: dict[str, list[float]] = {}
    print("film  fps    gap   bits framing    f ppm      +-   t_r %     gap %  seen right ms")
    for number in range(first, count):
        judged = judge(film(number))
        one, clock = judged.film, judged.reading.clock
        truth = one.truth
        parts = []
        for name, scale in (
            ("switching_frequency", 1e6 / truth["switching_frequency"]),
            ("readout_time", 1e2 / truth["readout_time"]),
            ("gap", 1e2 * one.recording.frame_rate),
        ):
            if clock is None:
                parts.append("   none")
                continue
            off, error = judged.error(name)
            ratios.setdefault(name, []).append(off / error)
            parts.append(f"{scale * off:9.4f} {scale * error:7.4f}")
        transmitter = one.scene.transmitter
        print(
            f"{number:4d} {one.recording.frame_rate:6.2f} {one.recording.gap_ratio(one.scene):5.2f}"
            f" {transmitter.payload_length:5d} {transmitter.framing:9} {' '.join(parts)}"
            f" {judged.all_seen!s:5} {judged.is_right!s:5} {judged.milliseconds:5.1f}"
            f" {one.recording.frame_jitter * 1e6:4.0f} {one.recording.frame_times:8}"
            f" {judged.reading.failure or ''} {clock.problems if clock else ''}",
            flush=True,
        )
    for name, values in ratios.items():
        within = np.mean(np.abs(values) < 1.0)
        print(f"{name}: {100 * within:.0f} % within one standard deviation")
    together = np.abs(np.concatenate(list(ratios.values())))
    print(f"together: {100 * np.mean(together < 1.0):.0f} %")


if __name__ == "__main__":
    given = [int(text) for text in sys.argv[1:]]
    main(given[0] if len(given) > 1 else 0, given[-1] if given else FILMS)

"""How often the matched decoder reads a wrong code, and how sure it is then.

``python tests/benchmarks/confidence.py`` runs 10,000 trials: codes, start times, 4 to 60 kHz,
300 to 1800 columns, noise of 0.01 to 32 grey levels on the column means, 136 us.
"""

import argparse

import numpy as np

import occ_model as occ


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=10_000)
    trials = parser.parse_args().trials
    random = np.random.default_rng(2026)
    base = occ.load_preset("phone-136us").replace(enhancement="none")
    right: list[float] = []
    wrong: list[float] = []
    for _ in range(trials):
        scene = base.replace(
            code=int(random.integers(1024)),
            switching_frequency=float(random.uniform(4e3, 60e3)),
            start_time=float(random.uniform(0.0, 0.02)),
            columns=int(random.integers(300, 1800)),
        )
        profile = occ.column_profile(scene)
        noise = float(10 ** random.uniform(-2.0, 1.5))
        result = occ.decode(profile + random.normal(0.0, noise, len(profile)), scene, "matched")
        if result.code is not None and result.confidence is not None:
            kept = right if result.code == scene.transmitter.code else wrong
            kept.append(result.confidence)
    print(f"{trials} trials: {len(right)} read rightly, {len(wrong)} wrongly")
    print(f"largest confidence of a wrong one {max(wrong, default=0.0):.3f}")
    print(f"read rightly with a confidence of 0.5 or more: {sum(c >= 0.5 for c in right)}")


if __name__ == "__main__":
    main()

"""Which decoder reads which scheme, and up to which frequency.

``python tests/benchmarks/schemes.py`` prints the tables of ``resources/docs/codes.md``: how many
of 20 random payloads of 10 bits each decoder reads at 4 kHz and 68 us, for every scheme;
and the highest frequency up to which it reads all of each line code at 136 us. The panel is 0.6 m
away, the enhancement off; the columns' means have noise of one grey level.
"""

import argparse

import numpy as np

import occ_model as occ
from occ_model.receiver.decoders import DECODERS
from occ_model.scene.scene import Scene
from occ_model.study.bit_error_rate import with_payload

BITS = 10
FREQUENCIES = tuple(np.arange(4e3, 61e3, 2e3).tolist())


def scene_of(line_code: str, framing: str, preset: str, **changes: float) -> Scene | str:
    """Give the scene that sends a scheme, or the sentence that refuses it."""
    try:
        scene = occ.load_preset(preset).replace(
            enhancement="none", distance=0.6, line_code=line_code, framing=framing,
            payload="bits:" + "0" * BITS, **changes,
        )  # fmt: skip
        occ.scheme_of(scene.transmitter)
        occ.packet(scene)
    except occ.OccError as refusal:
        return str(refusal)
    return scene


def read(scene: Scene, decoder: str, pictures: int) -> tuple[int, int, str]:
    """Count the payloads that are read rightly and wrongly, and say why the first one is not."""
    random = np.random.default_rng(1)
    right, wrong, why = 0, 0, ""
    period = len(occ.packet(scene)) * scene.transmitter.switching_period
    for _ in range(pictures):
        bits = random.integers(0, 2, BITS)
        sent = with_payload(scene, bits.tolist()).replace(start_time=random.uniform(0.0, period))
        signal = occ.column_profile(sent) + random.standard_normal(sent.camera.columns)
        found = occ.decode(signal, sent, decoder)
        is_right = found.failure is None and np.array_equal(found.bits, bits)
        right += is_right
        wrong += found.failure is None and not is_right
        why = why or found.failure or ""
    return right, wrong, why


def print_schemes(pictures: int) -> None:
    """Print the table of every scheme and decoder."""
    print(f"| line code | framing | {' | '.join(DECODERS)} |\n|---|---|{'---|' * len(DECODERS)}")
    reasons: dict[str, None] = {}
    for line_code in occ.line_codes():
        for framing in occ.framings():
            scene = scene_of(line_code, framing, "phone-68us", switching_frequency=4e3)
            if isinstance(scene, str):
                reasons[f"{line_code}, {framing}: {scene}"] = None
                continue
            cells = []
            for decoder in DECODERS:
                right, wrong, why = read(scene, decoder, pictures)
                cells.append(f"{right}" + (f" (+{wrong} wrong)" if wrong else ""))
                if right + wrong < pictures:
                    reasons[f"{line_code}, {framing}, {decoder}: {why}"] = None
            print(f"| `{line_code}` | `{framing}` | {' | '.join(cells)} |", flush=True)
    print("\n" + "\n".join(reasons))


def print_limits(pictures: int) -> None:
    """Print the highest frequency at which every payload is read, and all below it from 4 kHz."""
    print(f"| line code | {' | '.join(DECODERS)} |\n|---|{'---|' * len(DECODERS)}")
    for line_code in occ.line_codes():
        cells = []
        for decoder in DECODERS:
            highest = "none"
            for frequency in FREQUENCIES:
                scene = scene_of(
                    line_code, "preamble", "phone-136us", switching_frequency=frequency
                )
                if isinstance(scene, str) or read(scene, decoder, pictures)[0] < pictures:
                    break
                highest = f"{frequency / 1e3:g} kHz"
                highest += " or more" if frequency == FREQUENCIES[-1] else ""
            cells.append(highest)
        print(f"| `{line_code}` | {' | '.join(cells)} |", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pictures", type=int, default=20)
    parser.add_argument("--part", choices=("schemes", "limits", "both"), default="both")
    options = parser.parse_args()
    if options.part != "limits":
        print_schemes(options.pictures)
    if options.part != "schemes":
        print_limits(options.pictures)


if __name__ == "__main__":
    main()

"""How many codes each decoder reads: the figures of ``resources/docs/validation.md``.

``python tests/benchmarks/decoders.py PART``, or all parts in turn:

* ``frequency``: codes read over the switching frequency, of the presets phone-136us and
  phone-136us-real, without histogram equalization and with it;
* ``timing``: the same with an exposure time or a readout time that the receiver has wrong by 0.1,
  0.3 and 1 %;
* ``pose``: of all codes, those read from tilted, cut-off and noisy pictures. Each code gets one
  picture a cell, with a random start time, all of whose pixels are made and decoded;
* ``confidence``: how often the matched decoder reads a wrong code, and how sure it is then, in
  trials of other codes, start times, 4 to 60 kHz, 300 to 1800 columns, noise of 0.01 to 32 grey
  levels on the column means, 136 us;
* ``scheme``: random payloads of 10 bits read of every scheme, at 4 kHz and 68 us;
* ``line-code``: the highest frequency up to which all such payloads are read, at 136 us. In this
  part and ``scheme`` the panel is 0.6 m away, the enhancement off; the columns' means have noise of
  one grey level;
* ``together``: processor time of each decoder for 40 pictures, one at a time and all together, in
  turn in one process.
"""

import argparse
import math
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np

import occ_model as occ
from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.photometry import level_values
from occ_model.camera.projection import row_spans
from occ_model.effects.plan import complete_plan
from occ_model.receiver.decode import DECODERS, decode_profiles
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.bit_error_rate import with_payload
from occ_model.study.signals.batch import simulate_images
from occ_model.study.signals.pictures import picture_itself

PRESETS = ("phone-136us", "phone-136us-real")
ENHANCEMENTS = ("none", "equalization")
WRONG_BY = (0.0, 0.001, 0.003, 0.01)
POSES: dict[str, dict[str, float]] = {
    "level": {},
    "roll 30°": {"roll": math.radians(30)},
    "yaw 30°": {"yaw": math.radians(30)},
    "pitch 30°": {"pitch": math.radians(30)},
    "two thirds outside": {"offset_x": 0.6},
}
NOISES = (1.0, 3.0, 10.0)
BITS = 10
_TOGETHER = 40  # pictures that are read together
FREQUENCIES = tuple(np.arange(4e3, 61e3, 2e3).tolist())


def signal_of(scene: Scene, random: np.random.Generator) -> FloatArray:
    """Return the column means that a decoder reads of one picture."""
    plan = complete_plan(scene, SimulationSettings(observable="signal"))
    (seen,) = simulate_images([picture_itself(scene, plan, int(random.integers(2**32)))])
    return np.asarray(seen.signal, dtype=np.float64)


def counts(
    base: Scene, codes: int, wrong: dict[str, float] | None = None
) -> dict[str, tuple[int, int]]:
    """Count the codes that each decoder reads correctly and wrongly.

    The receiver has the parameters in ``wrong`` off by these fractions.
    """
    frequency = base.transmitter.switching_frequency
    random = np.random.default_rng(int(frequency))
    found = dict.fromkeys(DECODERS, (0, 0))
    for code in random.integers(0, 1024, codes).tolist():
        scene = base.replace(code=code, start_time=float(random.uniform(0.0, 24.0 / frequency)))
        signal = signal_of(scene, random)
        off = {name: getattr(scene.camera, name) * (1 + by) for name, by in (wrong or {}).items()}
        for name, (right, other) in found.items():
            read = occ.decode(signal, scene.replace(**off), name).code
            found[name] = (right + (read == code), other + (read not in (code, None)))
    return found


def written(found: dict[str, tuple[int, int]]) -> str:
    """Write the counts as cells: right ones, and wrong ones behind a plus."""
    cells = (
        f"{right}" + (f" (+{wrong} wrong)" if wrong else "") for right, wrong in found.values()
    )
    return " | ".join(cells)


def print_frequencies(options: argparse.Namespace) -> None:
    frequencies = 1e3 * np.arange(2.0, 40.0 + 0.5 * options.step, options.step)
    for preset in PRESETS:
        for enhancement in ENHANCEMENTS:
            print(f"\n{preset}, enhancement {enhancement}, of {options.codes} codes\n")
            print(f"| frequency | {' | '.join(DECODERS)} |\n|---|{'---|' * len(DECODERS)}")
            base = occ.load_preset(preset).replace(enhancement=enhancement)
            for frequency in frequencies.tolist():
                found = counts(base.replace(switching_frequency=frequency), options.codes)
                print(f"| {frequency / 1e3:g} kHz | {written(found)} |", flush=True)


def print_together(options: argparse.Namespace) -> None:
    """Print the time of a picture that is read alone, and how many times faster 40 together are."""
    random = np.random.default_rng(6)
    print(f"| frequency | {' | '.join(DECODERS)} |\n|---|{'---|' * len(DECODERS)}")
    for frequency in (4e3, 14e3, 50e3):
        base = occ.load_preset("phone-136us").replace(switching_frequency=frequency)
        scenes = [base.replace(start_time=one) for one in random.uniform(0.0, 0.01, _TOGETHER)]
        signals = [signal_of(scene, random) for scene in scenes]
        cells = []
        for name in DECODERS:
            alone, together = [], []
            for _ in range(options.rounds):
                start = time.process_time()
                for signal, scene in zip(signals, scenes, strict=True):
                    occ.decode(signal, scene, name)
                middle = time.process_time()
                decode_profiles(signals, scenes, name)
                alone.append(middle - start)
                together.append(time.process_time() - middle)
            each = 1e3 * min(alone) / _TOGETHER
            cells.append(f"{each:.2f} ms, {min(alone) / min(together):.2f} times")
        print(f"| {frequency / 1e3:g} kHz | {' | '.join(cells)} |", flush=True)


def print_wrong_timings(options: argparse.Namespace) -> None:
    base = occ.load_preset("phone-136us").replace(enhancement="none")
    for parameter in ("readout_time", "exposure_time"):
        print(f"\n{parameter} wrong, phone-136us, enhancement none, of {options.codes} codes\n")
        head = f"| wrong by | frequency | {' | '.join(DECODERS)} |"
        print(f"{head}\n|---|---|{'---|' * len(DECODERS)}")
        for by in WRONG_BY:
            for frequency in (10e3, 20e3, 30e3):
                at = base.replace(switching_frequency=frequency)
                cells = written(counts(at, options.codes, {parameter: by}))
                print(f"| {100 * by:g} % | {frequency / 1e3:g} kHz | {cells} |", flush=True)


def noisy_image(scene: Scene, noise: float, random: np.random.Generator) -> ByteArray:
    """Make the image with this many grey levels of noise in each pixel, whatever its light."""
    profile = occ.column_profile(scene)
    enhancement = Enhancement(profile, scene.model.enhancement)
    rows = scene.camera.rows
    values = float(level_values(scene)[0]) + noise * random.standard_normal((rows, len(profile)))
    image = to_bytes(values)
    first, last = row_spans(occ.panel_corners(scene), rows, len(profile))
    for row in range(rows):
        panel = slice(int(first[row]), int(last[row]))
        deviations = noise * random.standard_normal(panel.stop - panel.start)
        image[row, panel] = enhancement(profile[panel] + deviations)
    return image


def codes_read(pose: str, noise: float, codes: int) -> list[int]:
    """Count the codes that each decoder reads in one pose at one noise."""
    base = occ.load_preset("phone-136us").replace(
        switching_frequency=10e3, distance=1.0, rows=480, panel_height=0.1, **POSES[pose]
    )
    # The same angle of view as the whole sensor, of which only the middle rows are read.
    whole = occ.load_preset("phone-136us").camera
    base = base.replace(
        equivalent_focal_length=whole.equivalent_focal_length
        * whole.focal_length_pixels
        / base.camera.focal_length_pixels
    )
    random = np.random.default_rng((int(noise), *pose.encode()))
    read = [0] * len(DECODERS)
    for code in np.linspace(0, 1023, codes).astype(int).tolist():
        scene = base.replace(code=code, start_time=float(random.uniform(0.0, 2.4e-3)))
        image = noisy_image(scene, noise, random)
        for place, name in enumerate(DECODERS):
            read[place] += occ.decode(image, scene, name).code == code
    return read


def print_poses(options: argparse.Namespace) -> None:
    names = [f"{name}, noise {noise:.0f}" for noise in NOISES for name in DECODERS]
    print(f"| pose | {' | '.join(names)} |\n|---{'|---' * len(names)}|", flush=True)
    with ProcessPoolExecutor(options.jobs) as pool:
        for pose in POSES:
            cells = pool.map(partial(codes_read, pose, codes=options.all_codes), NOISES)
            fractions = [100.0 * read / options.all_codes for cell in cells for read in cell]
            row = " | ".join(f"{fraction:.1f} %" for fraction in fractions)
            print(f"| {pose} | {row} |", flush=True)


def print_confidences(options: argparse.Namespace) -> None:
    random = np.random.default_rng(2026)
    base = occ.load_preset("phone-136us").replace(enhancement="none")
    right: list[float] = []
    wrong: list[float] = []
    for _ in range(options.trials):
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
    print(f"{options.trials} trials: {len(right)} read correctly, {len(wrong)} wrongly")
    print(f"largest confidence of a wrong one {max(wrong, default=0.0):.3f}")
    print(f"read correctly with a confidence of 0.5 or more: {sum(c >= 0.5 for c in right)}")


def scene_of(line_code: str, framing: str, preset: str, **changes: float) -> Scene | str:
    """Return the scene that sends a scheme, or the sentence that refuses it."""
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


def payloads_read(scene: Scene, decoder: str, pictures: int) -> tuple[int, int, str]:
    """Count the payloads that are read correctly and wrongly, and say why the first one is not."""
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


def print_schemes(options: argparse.Namespace) -> None:
    print(f"| line code | framing | {' | '.join(DECODERS)} |\n|---|---|{'---|' * len(DECODERS)}")
    reasons: dict[str, None] = {}
    for line_code in occ.line_codes():
        for framing in occ.framings():
            scene = scene_of(line_code, framing, "phone-68us", switching_frequency=4e3)
            if isinstance(scene, str):
                reasons[f"{line_code}, {framing}: {scene}"] = None
                continue
            found = {}
            for decoder in DECODERS:
                right, wrong, why = payloads_read(scene, decoder, options.codes)
                found[decoder] = right, wrong
                if right + wrong < options.codes:
                    reasons[f"{line_code}, {framing}, {decoder}: {why}"] = None
            print(f"| `{line_code}` | `{framing}` | {written(found)} |", flush=True)
    print("\n" + "\n".join(reasons))


def print_line_codes(options: argparse.Namespace) -> None:
    """Print the highest frequency up to which every payload is read, from 4 kHz on."""
    print(f"| line code | {' | '.join(DECODERS)} |\n|---|{'---|' * len(DECODERS)}")
    for line_code in occ.line_codes():
        cells = []
        for decoder in DECODERS:
            highest = "none"
            for frequency in FREQUENCIES:
                scene = scene_of(
                    line_code, "preamble", "phone-136us", switching_frequency=frequency
                )
                if (
                    isinstance(scene, str)
                    or payloads_read(scene, decoder, options.codes)[0] < options.codes
                ):
                    break
                highest = f"{frequency / 1e3:g} kHz"
                highest += " or more" if frequency == FREQUENCIES[-1] else ""
            cells.append(highest)
        print(f"| `{line_code}` | {' | '.join(cells)} |", flush=True)


PARTS = {
    "frequency": print_frequencies,
    "timing": print_wrong_timings,
    "pose": print_poses,
    "confidence": print_confidences,
    "scheme": print_schemes,
    "together": print_together,
    "line-code": print_line_codes,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("parts", nargs="*", metavar="part", help=f"{', '.join(PARTS)}; default: all")
    add("--codes", type=int, default=20, help="or payloads of a row, default: %(default)s")
    add("--step", type=float, default=1.0, help="of the frequencies in kHz, default: %(default)s")
    add("--all-codes", type=int, default=1024, help="how many of the 1024 codes in a pose")
    add("--trials", type=int, default=10_000, help="of the confidence, default: %(default)s")
    add("--rounds", type=int, default=3, help="of which the fastest counts, default: %(default)s")
    add("--jobs", type=int, default=2)
    options = parser.parse_args()
    for part in options.parts or PARTS:
        PARTS[part](options)


if __name__ == "__main__":
    main()

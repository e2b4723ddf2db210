"""How many codes each detector reads over the switching frequency, and with a wrong timing.

``python tests/benchmarks/detectors.py`` prints the tables of ``resources/docs/decoders.md``: the
presets phone-136us and phone-136us-real, without histogram equalization and with it, and the same
with an exposure time or a readout time that the receiver has wrong by 0.1, 0.3 and 1 %.
"""

import argparse

import numpy as np

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.effects.paper_view import paper_view_of
from occ_model.effects.plan import plan_of
from occ_model.effects.registry import NAMES
from occ_model.receiver.decoders import DECODERS
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.simulation.row_sample import sample_picture
from occ_model.study.observation import observe_profile, observe_sample, panel_span

PRESETS = ("phone-136us", "phone-136us-real")
ENHANCEMENTS = ("none", "equalization")
WRONG_BY = (0.0, 0.001, 0.003, 0.01)


def signal_of(scene: Scene, random: np.random.Generator) -> FloatArray:
    """Give the column means that a decoder reads of one picture."""
    view = paper_view_of(scene)
    chosen = plan_of(view, SimulationSettings(observable="signal").checked(NAMES))
    span = panel_span(scene)
    if span is not None and "image" not in chosen.kinds:
        return np.asarray(observe_profile(view, span, chosen, random).signal, dtype=np.float64)
    sample = sample_picture(view, chosen, int(random.integers(2**32)))
    seen = None if sample is None else observe_sample(sample, scene, chosen, random)
    assert seen is not None
    return np.asarray(seen.signal, dtype=np.float64)


def counts(
    base: Scene, codes: int, wrong: dict[str, float] | None = None
) -> dict[str, tuple[int, int]]:
    """Count the codes that each decoder reads rightly and wrongly.

    The receiver has the parameters in ``wrong`` off by these shares.
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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--codes", type=int, default=20)
    parser.add_argument("--step", type=float, default=1.0, help="kHz")
    parser.add_argument("--part", choices=("frequency", "timing", "both"), default="both")
    options = parser.parse_args()
    frequencies = 1e3 * np.arange(2.0, 40.0 + 0.5 * options.step, options.step)
    names = " | ".join(DECODERS)
    rule = "---|" * len(DECODERS)
    for preset in PRESETS if options.part != "timing" else ():
        for enhancement in ENHANCEMENTS:
            print(f"\n{preset}, enhancement {enhancement}, of {options.codes} codes\n")
            print(f"| frequency | {names} |\n|---|{rule}")
            base = occ.load_preset(preset).replace(enhancement=enhancement)
            for frequency in frequencies.tolist():
                found = counts(base.replace(switching_frequency=frequency), options.codes)
                print(f"| {frequency / 1e3:g} kHz | {written(found)} |", flush=True)
    for parameter in ("readout_time", "exposure_time") if options.part != "frequency" else ():
        print(f"\n{parameter} wrong, phone-136us, enhancement none, of {options.codes} codes\n")
        print(f"| wrong by | frequency | {names} |\n|---|---|{rule}")
        base = occ.load_preset("phone-136us").replace(enhancement="none")
        for by in WRONG_BY:
            for frequency in (10e3, 20e3, 30e3):
                at = base.replace(switching_frequency=frequency)
                found = counts(at, options.codes, {parameter: by})
                print(
                    f"| {100 * by:g} % | {frequency / 1e3:g} kHz | {written(found)} |", flush=True
                )


if __name__ == "__main__":
    main()

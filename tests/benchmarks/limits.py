"""Print the table of limits of all presets, with the processor time of each line's search.

python tests/benchmarks/limits.py
python tests/benchmarks/limits.py --preset phone-136us --decoder threshold

How surely the ends are known is not searched, which takes several times as long.
"""

import argparse
import time

import occ_model as occ
from occ_model.commands.limits import range_cells
from occ_model.results.limits import Limits
from occ_model.results.sweep_request import RateSettings
from occ_model.study.limits import SEARCHED
from occ_model.study.working_range import working_range

COLUMNS = (
    "preset", "decoder", "lowest", "highest", "gaps", "shortest", "longest", "gaps",
    "bits a second", "time",
)  # fmt: skip

RATE, IMAGES, SEED = 99.0, 20, 1


def line(preset: str, decoder: str) -> str:
    """Search for the limits of a decoder and write them as a line of the table."""
    scene, settings = occ.load_preset(preset), RateSettings(IMAGES, (decoder,), SEED)
    start = time.process_time()
    ranges = [working_range(scene, name, RATE, settings) for name in SEARCHED]
    seconds = time.process_time() - start
    found = Limits(scene, decoder, RATE, IMAGES, SEED, *ranges)
    cells = [preset, decoder, *(cell for each in ranges for cell in range_cells(each))]
    return f"| {' | '.join([*cells, f'{found.bits_a_second():.4g}', f'{seconds:.1f} s'])} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--preset", action="append", choices=occ.presets())
    parser.add_argument("--decoder", action="append", choices=occ.decoders())
    asked = parser.parse_args()
    print(f"| {' | '.join(COLUMNS)} |")
    print("|---" * len(COLUMNS) + "|")
    for preset in asked.preset or occ.presets():
        for decoder in asked.decoder or ("threshold", "matched", "equalizer", "sequence"):
            print(line(preset, decoder), flush=True)


if __name__ == "__main__":
    main()

"""What is read of real photographs, by a table of what is known of them.

    python tests/benchmarks/real_photos.py FOLDER

FOLDER has a ``truths.csv`` with the columns file, group, scan, known, lamp_frequency_hz,
readout_time_s, chips and tolerance. ``known`` is what the program is told, such as
``readout_time=21us``; ``ratios`` where only the ratios of several lamps are known. Printed are for
each file the verdict, the value, its error relative to the truth and in stated errors, and the
processor time; then a count for each group. Nothing of the photographs is kept.
"""

import sys
import time
from collections import Counter, defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from photo_world.real_views import load_known_photos, read_answers


def main(folder: Path) -> None:
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for known in load_known_photos(folder):
        start = time.process_time()
        found = read_answers(known)
        spent = time.process_time() - start
        for answer in found:
            kind = answer.verdict + (" wrong" if answer.is_wrong(known.tolerance) else "")
            counts[known.group][kind] += 1
            print(f"{known.group:8} {known.file.name:20} {answer.line()}  {spent:.2f} s")
    for group, count in counts.items():
        print(f"{group:8} {dict(count)}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

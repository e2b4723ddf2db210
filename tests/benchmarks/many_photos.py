"""What many photos cost: ``python tests/benchmarks/many_photos.py [count] [jobs]``.

100 JPEG photos of 12 million pixels (or as many as named) are read and matched by two processes (or
as many as named). Only a few of them are simulated; the others are copies. Some are matched by one
process first: its processor time shows what each costs also where the machine has other work.
"""

import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time

import cv2
from tqdm import tqdm

import occ_model as occ
from occ_model.scene.scene import Scene

_ROWS, _COLUMNS = 3024, 4032
_DIFFERENT = 4
_QUALITY = 92


def _scene() -> Scene:
    return occ.load_preset("phone-136us-real").replace(
        rows=_ROWS, columns=_COLUMNS, switching_frequency=6e3, enhancement="none", jpeg_quality=100
    )


def _photos(folder: Path, count: int) -> list[Path]:
    """Write photos of different noise, and copies of them."""
    paths = [folder / f"{number:03}.jpg" for number in range(count)]
    for number, path in enumerate(paths):
        if number < _DIFFERENT:
            image = occ.render(_scene(), tolerance=0.0, seed=number).image
            cv2.imwrite(str(path), image, [cv2.IMWRITE_JPEG_QUALITY, _QUALITY])
        else:
            shutil.copyfile(paths[number % _DIFFERENT], path)
    return paths


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    jobs = int(sys.argv[2]) if len(sys.argv) > 2 else 2
    told = _scene().replace(readout_time=1e-6, exposure_time=1e-3)
    with TemporaryDirectory() as folder:
        paths = _photos(Path(folder), count)
        start = process_time()
        occ.match_photos(paths[:_DIFFERENT], told)
        each = (process_time() - start) / min(count, _DIFFERENT)
        with tqdm(total=count, desc="photos") as bar:
            start = perf_counter()
            table = occ.match_photos(
                paths, told, jobs=jobs, progress=lambda done, _count: bar.update(done - bar.n)
            )
            passed = perf_counter() - start
    sure = sum(row.verdict == "sure" for row in table.rows)
    print(
        f"{count} photos of {_ROWS * _COLUMNS / 1e6:.0f} million pixels by {jobs} processes: "
        f"{passed:.1f} s; {each:.2f} s of processor time each by one process; {sure} sure"
    )


if __name__ == "__main__":
    main()

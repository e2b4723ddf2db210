"""Match many photos of one camera and one scene: one readout time from all of them.

Files may be matched in several processes; if a file ends its process, the others continue.
"""

import os
import warnings
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from itertools import chain
from pathlib import Path
from typing import TypeAlias

from occ_model.errors import ParameterError, PhotoError, quote
from occ_model.parallel.job import Heartbeat, Job, Workers, WorkersLostError
from occ_model.parallel.scheduler import results_of
from occ_model.photo.many.row import MatchSettings, row_of
from occ_model.photo.many.table import table_of
from occ_model.photo.match import ESTIMATES, PATTERN_SOURCES
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import Photo
from occ_model.results.photo_table import UNREADABLE, PhotoRow, PhotoTable
from occ_model.scene.argument_checks import check_count
from occ_model.scene.scene import Scene

Progress: TypeAlias = Callable[[int, int], object]
"""Called with the number of photos done, and of all photos."""

MOST_JOBS = 64

Source: TypeAlias = Path | Photo

PRELOAD = "occ_model.photo.many.row"  # the module that a worker process needs

Files: TypeAlias = Iterable[tuple[int, Path]]
"""The files to match, each with its place in the table."""

Rows: TypeAlias = Generator[tuple[int, PhotoRow], None, None]
"""Rows of the table, each with its place."""


def match_photos(  # noqa: PLR0913 - how photos are read and matched, all of it optional
    photos: Iterable[str | Path | Photo],
    scene: Scene,
    *,
    estimate: str = ESTIMATES[0],
    sent: str = PATTERN_SOURCES[0],
    averaging: str = "auto",
    fit_gamma: bool = False,
    scan_axis: str = SCAN_AXES[0],
    channel: str = CHANNELS[0],
    known: Mapping[int, float] | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
) -> PhotoTable:
    """Match many photos of one scene, and combine their estimates.

    The mean is over the photos that are sure, without outliers; a doubtful one never changes it.
    Its uncertainty follows from the photos' scatter and errors. It excludes the error of the given
    frequency or readout time.

    Parameters
    ----------
    photos
        Files, or photos that were read already.
    scene
        The known settings, as for :func:`occ_model.match_photo`.
    estimate, sent, averaging, fit_gamma
        As for :func:`occ_model.match_photo`.
    scan_axis, channel
        As for :func:`occ_model.load_photo`; for files only.
    known
        Values of the known parameter in SI units for single photos, by their indices from 0: the
        frequency of another lamp, or the readout time of another camera. All others have the
        scene's value.
    jobs
        Number of processes that read and match files; 1: only this one. With more, the calling
        module must not call this when it is imported (``if __name__ == "__main__":``).
    progress
        Called after each photo, and several times a second in between, with the number of finished
        photos and the total number. An exception from it ends the work.

    Returns
    -------
    PhotoTable
        A row for each photo, in their order. The row of a file that cannot be read, or of a photo
        that no scene explains, states why.

    Raises
    ------
    ParameterError
        A setting, a known value or ``jobs`` is not allowed, or there are no photos.
    PhotoError
        One of the photos is neither a path nor a photo.
    """
    settings = MatchSettings(
        scene, estimate, sent, averaging, fit_gamma, scan_axis, channel,
        tuple((known or {}).items()),
    )  # fmt: skip
    sources = check_photos(photos)
    for place in known or ():
        check_count("place of a known value", place, 0, len(sources) - 1)
    settings.check()
    check_count("jobs", jobs, 1, MOST_JOBS)
    report = progress or (lambda _done, _total: None)
    rows: dict[int, PhotoRow] = {}
    report(0, len(sources))

    def heartbeat() -> None:
        report(len(rows), len(sources))

    # Workers that are not closed would continue after an error.
    with closing(match_rows(sources, settings, jobs, heartbeat)) as matched:
        for place, row in matched:
            rows[place] = row
            heartbeat()
    return table_of(settings, [rows[place] for place in range(len(sources))])


def check_photos(photos: Iterable[str | Path | Photo]) -> list[Source]:
    items = [photos] if isinstance(photos, str | Path | Photo) else photos
    sources: list[Source] = []
    for photo in items:
        if not isinstance(photo, str | Path | Photo):
            raise PhotoError(
                f"{quote(photo)} is not the path of a photo; allowed: str, Path or Photo."
            )
        sources.append(Path(photo) if isinstance(photo, str) else photo)
    if not sources:
        raise ParameterError("There are no photos to match; allowed: one or more.")
    return sources


def match_rows(
    sources: Sequence[Source], settings: MatchSettings, jobs: int, heartbeat: Heartbeat
) -> Generator[tuple[int, PhotoRow], None, None]:
    """Match photos, and yield each row with its index as soon as it is ready."""
    files = [(place, source) for place, source in enumerate(sources) if isinstance(source, Path)]
    for place, source in enumerate(sources):
        if isinstance(source, Photo):
            yield row_of(place, source, settings, heartbeat)
    if jobs > 1 and len(files) > 1:
        yield from match_by_workers(files, settings, min(jobs, len(files)), heartbeat)
        return
    for place, path in files:
        yield row_of(place, path, settings, heartbeat)


def usual_jobs() -> int:
    """Return the number of cores that this process may use, at most MOST_JOBS."""
    try:
        cores = len(os.sched_getaffinity(0))
    except AttributeError:  # not on every system
        cores = os.cpu_count() or 1
    return min(cores, MOST_JOBS)


def match_by_workers(
    files: Files, settings: MatchSettings, jobs: int, heartbeat: Heartbeat
) -> Rows:
    """Match files in processes, in the order in which they are ready.

    If processes end repeatedly, their files are matched one by one, and a file that ends its
    process even then gets a row that says so. If the system cannot start processes, a thread of
    this one matches the files; if processes start but cannot work, this process matches them, with
    a ``RuntimeWarning``.
    """
    waiting = iter(files)
    while True:
        sent: dict[int, Path] = {}
        try:
            yield from _match_in_processes(waiting, sent, settings, jobs, heartbeat)
        except WorkersLostError as error:
            reason = error.reason
        else:
            return
        if not _has_workers(settings, heartbeat):
            warnings.warn(
                f"Workers end before they work ({reason}); this process matches the photos alone.",
                RuntimeWarning,
                stacklevel=2,
            )
            for place, path in chain(sent.items(), waiting):
                yield row_of(place, path, settings, heartbeat)
            return
        for place, path in sent.items():
            try:
                yield from _match_in_processes(iter([(place, path)]), {}, settings, 1, heartbeat)
            except WorkersLostError as error:
                note = f"The process that reads and matches it ended each time ({error.reason})."
                yield place, PhotoRow(path, UNREADABLE, note)


def _has_workers(settings: MatchSettings, heartbeat: Heartbeat) -> bool:
    """Return whether a worker can do any job, by trying a path that is not a file."""
    try:
        return any(
            True for _ in _match_in_processes(iter([(0, Path())]), {}, settings, 1, heartbeat)
        )
    except WorkersLostError:
        return False


def _match_in_processes(
    files: Iterator[tuple[int, Path]],
    sent: dict[int, Path],
    settings: MatchSettings,
    jobs: int,
    heartbeat: Heartbeat,
) -> Rows:
    """Match files in processes; ``sent`` holds the files that workers are matching."""
    # Slow to import, and needed only to start processes.
    from occ_model.parallel.job import WorkerThread
    from occ_model.parallel.process_pool import ProcessPool

    def make_jobs() -> Iterator[Job]:
        for place, path in files:
            sent[place] = path
            yield Job(row_of, (place, path, settings))

    def start() -> Workers:
        return ProcessPool(jobs, PRELOAD)

    with closing(results_of(make_jobs(), start, heartbeat, WorkerThread)) as rows:
        for place, row in rows:
            del sent[place]
            yield place, row

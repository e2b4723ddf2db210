"""Writing of a film to a file."""

from dataclasses import dataclass
from pathlib import Path

import occ_model as occ
from occ_gui.background.task import Report
from occ_model.results.video import Video


@dataclass(frozen=True, eq=False, slots=True)
class FilmToSave:
    path: Path
    film: Video


def save_film(request: FilmToSave, report: Report) -> Path:
    count = request.film.frame_count or 1
    occ.write_video(request.film, request.path, lambda frames: report(frames / count))
    return request.path

"""Match one of several photos, which gives a row of their table even if it cannot be read."""

from dataclasses import dataclass, replace
from pathlib import Path

from occ_model.errors import MatchError, PhotoError
from occ_model.parallel.job import Heartbeat
from occ_model.photo.match import ESTIMATES, PATTERN_SOURCES, check_words, match_photo
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import Photo, load_photo
from occ_model.results.match import Match, known_parameter
from occ_model.results.photo_table import REFUSED, UNREADABLE, PhotoRow
from occ_model.results.sweep_csv import join_lines
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class MatchSettings:
    scene: Scene
    # estimate, sent, averaging, fit_gamma: as for :func:`occ_model.match_photo`.
    estimate: str = ESTIMATES[0]
    sent: str = PATTERN_SOURCES[0]
    averaging: str = "auto"
    fit_gamma: bool = False
    scan_axis: str = SCAN_AXES[0]  # scan_axis, channel: as for :func:`occ_model.load_photo`
    channel: str = CHANNELS[0]
    # Values of the known parameter for single photos, such as one of another lamp: pairs of the
    # photo's index and the value in SI units. All others have the scene's value.
    known: tuple[tuple[int, float], ...] = ()

    def of(self, place: int) -> "MatchSettings":
        value = dict(self.known).get(place)
        if value is None:
            return self
        known = known_parameter(self.estimate, self.scene.transmitter)
        return replace(self, scene=self.scene.replace(**{known: value}))

    def check(self) -> None:
        check_words(self.estimate, self.sent, self.averaging)
        check_choice("scan_axis", self.scan_axis, SCAN_AXES)
        check_choice("channel", self.channel, CHANNELS)
        for place, _ in self.known:
            self.of(place)


def row_of(
    place: int, source: Path | Photo, settings: MatchSettings, heartbeat: Heartbeat
) -> tuple[int, PhotoRow]:
    """Match the file or photo at an index of the table; a failure becomes a sentence in its row."""

    def report(_fraction: float) -> None:
        heartbeat()

    photo_settings, given = settings.of(place), dict(settings.known).get(place)
    if isinstance(source, Photo):
        photo = source
    else:
        try:
            photo = load_photo(
                source, photo_settings.scan_axis, channel=photo_settings.channel, progress=report
            )
        except PhotoError as error:
            note = join_lines(str(error))
            return place, PhotoRow(source, UNREADABLE, note, given=given)
    try:
        match = match_photo(
            photo,
            photo_settings.scene,
            estimate=photo_settings.estimate,
            sent=photo_settings.sent,
            averaging=photo_settings.averaging,
            fit_gamma=photo_settings.fit_gamma,
            progress=report,
        )
    except MatchError as error:
        row = _row(photo, REFUSED, str(error))
    else:
        row = _row(photo, match.verdict, " ".join(match.all_reasons), match)
    return place, replace(row, given=given)


def _row(photo: Photo, verdict: str, note: str, match: Match | None = None) -> PhotoRow:
    rows, columns = photo.samples.shape
    return PhotoRow(
        photo.path,
        verdict,
        join_lines(note),
        match,
        noted_exposure=photo.exposure_time,
        lines=columns,
        size=(rows, columns) if photo.turned else (columns, rows),
        scanned_along="lines" if photo.turned else "columns",
        camera=photo.camera,
    )

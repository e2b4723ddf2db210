"""Draw a study of films: packets received and bits a second against the gap."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.errors import inflect
from occ_model.figures.drawing import Drawing, write_all
from occ_model.scene.provenance import Provenance
from occ_model.scene.units import HERTZ
from occ_model.study.film_study import FilmPoint, FilmRequest, group_points

_HEADER = (
    "switching frequency (Hz)", "gap (fraction of a frame)", "payload (bits)", "packet (chips)",
    "packets sent", "packets read", "packets counted", "received", "received by counting",
    "received on average", "bits a second", "payload complete after (s)", "payload right",
    "failure",
)  # fmt: skip

_TITLE = "Films: packets received and bits a second over the gap"
_COLOURS = (colours.SIMULATION, colours.BAND, colours.PHOTO, colours.NOISE)
_MARKERS = "os^Dv"


def write_films_figure(folder: Path, request: FilmRequest, points: Sequence[FilmPoint]) -> None:
    provenance = Provenance(
        _TITLE,
        {"scene": request.scene},
        request.seed,
        (
            f"{inflect(request.frames, 'frame')} a film, {request.frame_rate:g} a second",
            request.decoder,
        ),
    )
    write_all(folder, [films_drawing(points)], lambda _drawing: provenance)


def films_drawing(points: Sequence[FilmPoint]) -> Drawing:
    def rows() -> Iterable[tuple[object, ...]]:
        for point in points:
            yield (
                point.frequency, point.gap, point.bits, point.packet_chips, point.packets,
                point.read, point.counted, point.reception, point.counted_reception,
                point.on_average, point.bits_per_second,
                "" if point.complete_at is None else point.complete_at, int(point.is_right),
                f"{point.failure or ''} {point.faults}".strip(),
            )  # fmt: skip

    return Drawing("films", _TITLE, lambda: _draw(points), _HEADER, rows)


def _draw(points: Sequence[FilmPoint]) -> Figure:
    figure = Figure(figsize=(7.6, 3.6))
    reception_axes, rate_axes = figure.subplots(1, 2)
    for number, ((frequency, bits), line) in enumerate(group_points(points).items()):
        style: dict[str, Any] = {
            "color": _COLOURS[number % len(_COLOURS)],
            "marker": _MARKERS[number // len(_COLOURS) % len(_MARKERS)],
        }
        gaps = [100.0 * point.gap for point in line]
        label = f"{HERTZ.format(frequency)}, {inflect(bits, 'bit')}"
        receptions = [100.0 * point.reception for point in line]
        reception_axes.plot(gaps, receptions, linestyle="", markersize=4, label=label, **style)
        counted_receptions = [
            100.0 * point.counted_reception for point in line
        ]  # without a receiver's errors
        reception_axes.plot(gaps, counted_receptions, linewidth=0.8, color=style["color"])
        rates = [point.bits_per_second for point in line]
        rate_axes.plot(gaps, rates, linewidth=0.8, markersize=4, **style)
    reception_axes.plot([], [], color="black", linewidth=0.8, label="by exact counting")
    _label_axes(reception_axes, "packets received (%)")
    _label_axes(rate_axes, "bits a second, repeats included")
    reception_axes.set_ylim(-4.0, 104.0)
    rate_axes.set_ylim(bottom=0.0)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=7)
    return figure


def _label_axes(ax: Axes, y_label: str) -> None:
    ax.set_xlabel("gap (% of a frame period)")
    ax.set_ylabel(y_label)
    ax.grid(linewidth=0.3)

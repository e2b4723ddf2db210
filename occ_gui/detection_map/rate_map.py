"""Success rates on a lattice over two parameters, filled in point by point."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.parameters import quantity

MAP_PARAMETERS = (
    "switching_frequency", "distance", "exposure_time", "readout_time", "iso", "f_number",
    "luminance", "illuminance", "reflectance", "panel_width", "panel_height",
    "equivalent_focal_length", "offset_x", "gamma", "edge_time", "flicker_depth",
    "flicker_frequency", "read_noise", "quantum_efficiency", "pixel_pitch", "full_well",
    "gain_variation", "bright_fraction",
)  # fmt: skip
"""Parameters that an axis can show: those with a slider that affect decoding and do not make rows
of the panel differ."""

STRIDES = (6, 3, 1)
"""Spacing of the points that are measured, in steps of the lattice, from coarse to fine."""

LINES = ("band", "null", "packets", "saturation")


def make_lattice(name: str, count: int) -> tuple[float, ...]:
    """Return values spaced evenly over a slider's range, on its scale."""
    parameter = quantity(name)
    return tuple(parameter.at(place / (count - 1)) for place in range(count))


@dataclass(frozen=True, eq=False, slots=True)
class TheoryFields:
    """On which side of each theoretical limit the points of a lattice lie."""

    # The points' positions along both sliders, from 0 to 1
    places: tuple[FloatArray, FloatArray]
    # Shape (points along x, points along y): for each of :data:`LINES` a
    # number that is 0 on the limit and changes its sign there; NaN where the limit does not exist
    sides: Mapping[str, FloatArray]

    def lines(self) -> dict[str, list[FloatArray]]:
        """Return the lines of each limit, each of shape (points, 2): positions along x and y.

        Cells of the lattice with a NaN at a corner have no line.
        """
        # Imported with the first map, not when the window starts.
        from contourpy import LineType, contour_generator

        lines = {}
        for limit, sides in self.sides.items():
            contours = contour_generator(
                *self.places,
                np.ma.masked_invalid(sides.T),
                corner_mask=False,
                line_type=LineType.Separate,
            )
            lines[limit] = [np.asarray(line) for line in contours.lines(0.0)]
        return lines


@dataclass(frozen=True, slots=True)
class PointFacts:
    x: float  # the parameters' values, in SI units
    y: float
    # For each decoder: its name, the number of bits read correctly, and both ends of the
    # confidence interval of its rate in percent
    counts: tuple[tuple[str, int, float, float], ...]
    sent: int  # bits sent; 0 if nothing is known
    images: int
    note: str
    whole: tuple[int, ...] = ()  # for each decoder, the images read without an error
    most_bits: float = 0.0  # bits a second if all were read


@dataclass(eq=False, slots=True)
class RateMap:
    x: str
    y: str
    x_values: tuple[float, ...]
    y_values: tuple[float, ...]
    decoders: tuple[str, ...]
    # Shape (points along x, points along y), or float: seconds in which a picture is read out,
    # which limits the number of pictures a second
    picture_times: FloatArray | float = 0.0
    enough_images: int = 1  # images of a point whose rate is shown without a doubt
    # Shape (points along x, points along y), and (..., decoders) for right and whole
    sent: IndexArray = field(init=False)  # bits sent
    right: IndexArray = field(init=False)  # bits read correctly
    whole: IndexArray = field(init=False)  # images read without an error
    images: IndexArray = field(init=False)  # images measured; 0 where nothing is known
    notes: dict[int, str] = field(init=False, default_factory=dict)  # by the index of the point
    theory: TheoryFields | None = field(init=False, default=None)
    # By the index of the point and the first image
    _waiting: dict[tuple[int, int], tuple[SweepPoint, int]] = field(
        init=False, default_factory=dict, repr=False
    )

    def __post_init__(self) -> None:
        shape = (len(self.x_values), len(self.y_values))
        self.sent = np.zeros(shape, dtype=np.int64)
        self.images = np.zeros(shape, dtype=np.int64)
        self.right = np.zeros((*shape, len(self.decoders)), dtype=np.int64)
        self.whole = np.zeros((*shape, len(self.decoders)), dtype=np.int64)

    @property
    def shape(self) -> tuple[int, int]:
        return len(self.x_values), len(self.y_values)

    def enter(self, points: Iterable[SweepPoint], images: int, first: int = 0) -> None:
        """Add the counts of the images from ``first`` up to ``images``, unless they are known.

        Counts that arrive before those of earlier images of the same point wait for them.
        """
        for point in points:
            place = divmod(point.index, len(self.y_values))
            if first >= self.images[place]:
                self._waiting[point.index, first] = point, images
            while next_one := self._waiting.pop((point.index, int(self.images[place])), None):
                self._add(place, *next_one)

    def _add(self, place: tuple[int, int], point: SweepPoint, images: int) -> None:
        self.sent[place] += point.sent
        self.right[place] += point.right
        self.whole[place] += point.whole
        self.images[place] = images
        if point.note and point.note not in (note := self.notes.get(point.index, "")):
            self.notes[point.index] = f"{note} {point.note}".strip()

    def point(self, index: int) -> SweepPoint:
        """Return what is known of a point."""
        place, note = divmod(index, len(self.y_values)), self.notes.get(index, "")
        right, whole = (tuple(each[place].tolist()) for each in (self.right, self.whole))
        return SweepPoint(index, int(self.sent[place]), right, note, whole)

    @property
    def known_count(self) -> int:
        return int(np.count_nonzero(self.images))

    @property
    def least_images(self) -> int:
        return int(self.images.min())

    def find_doubtful(self) -> BoolArray:
        """Return which points have too few images; shape (points along x, along y)."""
        return np.asarray(self.images < self.enough_images)

    def rates(self, decoder: str) -> FloatArray:
        """Return the rate of a decoder at every point in percent; NaN where unknown or refused."""
        rates = np.full(self.shape, np.nan)
        right = 100.0 * self.right[..., self.decoders.index(decoder)]
        np.divide(right, self.sent, out=rates, where=self.sent > 0)
        return rates

    def bits_a_second(self, decoder: str, frames_a_second: float) -> FloatArray:
        """Return the net bits a second with a payload in each picture.

        NaN where unknown or refused.
        """
        fraction = np.full(self.shape, np.nan)
        whole = self.whole[..., self.decoders.index(decoder)]
        np.divide(whole, self.images, out=fraction, where=self.sent > 0)
        return fraction * self.most_bits(frames_a_second)

    def most_bits(self, frames_a_second: float) -> FloatArray:
        """Return the bits a second at every point if all were read; 0 where unknown."""
        bits = np.zeros(self.shape)
        np.divide(self.sent, self.images, out=bits, where=self.sent > 0)
        with np.errstate(divide="ignore"):
            most = 1.0 / np.broadcast_to(np.asarray(self.picture_times), self.shape)
        return np.asarray(bits * np.minimum(frames_a_second, most))

    def find_refused(self) -> IndexArray:
        """Return 1 for points that the model refuses, else 0; shape (points along x, along y)."""
        return np.where((self.images > 0) & (self.sent == 0), 1, 0)

    def explain_refusal(self) -> str:
        """Return why all known points are refused, or that a plug-in has failed; else empty."""
        sent = self.sent.ravel()
        has_rate = np.any(sent > 0)
        return next((note for i, note in self.notes.items() if sent[i] or not has_rate), "")

    def find_rate_sources(self) -> tuple[IndexArray, IndexArray]:
        """Return, for each point, the indices along x and y of the known point whose rate it shows.

        Points that are not measured yet show the rate of a measured point nearby; -1 if there is
        none.
        """
        x, y = (np.full(self.shape, -1, dtype=np.int64) for _ in range(2))
        for stride in STRIDES:
            near = [np.rint(np.arange(n) / stride).astype(np.int64) * stride for n in self.shape]
            near_x, near_y = (np.minimum(p, n - 1) for p, n in zip(near, self.shape, strict=True))
            is_known = self.images[np.ix_(near_x, near_y)] > 0
            x[is_known] = np.broadcast_to(near_x[:, None], self.shape)[is_known]
            y[is_known] = np.broadcast_to(near_y, self.shape)[is_known]
        return x, y

"""Measure the straight edges of a rectangular lamp in a picture to a fraction of a pixel.

Dark chips hide a lamp's edge, which is therefore measured only where the lamp's light, which
repeats with the packet, is bright.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.coverage import column_spans
from occ_model.effects.distortion import subdivide
from occ_model.effects.normal_noise import normal_fraction
from occ_model.effects.optics_effects import blur_of
from occ_model.photo.photo_scene import with_allowed
from occ_model.room.edge_lines import (
    MIN_POINTS,
    Course,
    Edge,
    Line,
    distort_points,
    estimate_variance_ratio,
    fit_line,
)
from occ_model.room.room import Room, RoomLamp
from occ_model.room.seen_light import ApparentLight, LampLight, find_enhancement
from occ_model.scene.scene import Scene

_EDGE_REACH = 7  # minimum pixels on either side of an expected edge over which light is summed
_BLUR_REACH = 3.0  # standard deviations of the lens's blur over which light is summed as well
_LEVEL_PIXELS = 10  # further pixels, which give the levels of lamp and surroundings
_MIN_RELATIVE_LIGHT = 0.5  # fraction of the lamp's brightest light from which an edge is measured

_MIN_LEVEL_PIXELS = 4  # minimum pixels across an edge that determine the level inside
_MIN_LEVEL_POINTS = 8  # minimum number of bright points for each of them
_MOST_PASSES = 6  # over a side, each about the line found by the one before
_SETTLED = 0.2  # pixels up to which a line agrees with the course about which it was measured
_OF_PIXEL = math.sqrt(1.0 / 12.0)  # standard deviation of the blur by a pixel's own width
_SHARP = 0.3  # standard deviation in pixels of a blur below which no pixel is partly lit
_SEARCHED_POINTS = 64  # number of an edge's points used to search for it
_NOTHING = np.zeros((2, 2))
_SAMPLES = 16  # of each side's curve in the lamp's outline


def find_edges(image: ByteArray, room: Room, lamp: RoomLamp, corners: FloatArray) -> list[Edge]:
    """Measure a lamp's edges.

    ``corners``: the corners of its outline as a lens without distortion would show them, shape (4,
    2).
    """
    outline = distort_points(subdivide(corners, np.full(4, _SAMPLES)), room.scene)
    enhancement = find_enhancement(lamp, room, _take_middle(image, outline))
    seen, blur = ApparentLight(room.scene, enhancement), _find_blur(lamp, corners, room.scene)
    # The outline is at a tenth of the light, and the blurred rim is not the lamp's inside.
    margin = _EDGE_REACH + math.ceil(1.5 * _BLUR_REACH * blur)
    own = LampLight.of(image, outline, lamp, seen, margin)
    shown = _LampInPicture(image, room.scene, outline, seen, own, blur)
    lines = [shown.fit_line(corners[[side, (side + 1) % 4]]) for side in range(4)]
    found = [line for line in lines if line is not None]
    alike = estimate_variance_ratio(found)
    return [line.make_edge(alike) for line in found]


def _take_middle(image: ByteArray, outline: FloatArray) -> ByteArray:
    """Return the pixels well within an outline, in no particular order."""
    centre = outline.mean(axis=0)
    first, last = column_spans(centre + 0.5 * (outline - centre), *image.shape)
    shown = np.flatnonzero(last > first).tolist()
    return np.concatenate([image[:0, 0], *(image[first[one] : last[one], one] for one in shown)])


def _find_blur(lamp: RoomLamp, corners: FloatArray, scene: Scene) -> float:
    """Return the lens's blur in pixels at a lamp's distance, estimated from its size."""
    x, y = corners.T
    area = max(abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2.0, 1.0)
    distance = scene.camera.focal_length_pixels * math.sqrt(math.prod(lamp.size) / area)
    return blur_of(with_allowed(scene, distance=distance))


@dataclass(frozen=True, eq=False, slots=True)
class _LampInPicture:
    image: ByteArray
    scene: Scene
    outline: FloatArray  # the lamp's approximate outline in the picture
    seen: ApparentLight
    own: LampLight
    blur: float

    def fit_line(self, ends: FloatArray) -> Line | None:
        """Measure an edge where it is expected, and repeatedly where it was found."""
        pixels = self._take_across(Course.of(ends, self.scene))
        if pixels is None:
            return None
        ends = pixels.search_ends()
        for _ in range(_MOST_PASSES):
            pixels = self._take_across(Course.of(ends, self.scene))
            line = None if pixels is None else pixels.fit_line()
            if line is None or np.abs(line.shift).max() < _SETTLED:
                return line
            ends = line.course.move(line.shift)
        return None

    def _take_across(self, course: Course) -> "_PixelsAcross | None":
        """Return the pixels across an edge; None if too few of its points have enough pixels."""
        level, seen = course.axis == 0, self.seen
        image, outline = (
            (self.image, self.outline) if level else (self.image.T, self.outline[:, ::-1])
        )
        steepest = float(course.steepness.max(initial=1.0))
        reach = max(_EDGE_REACH, math.ceil(_BLUR_REACH * self.blur * steepest))
        size = reach + _LEVEL_PIXELS
        course = course.cut_ends(size - 2)
        middle = np.rint(course.across).astype(np.int64)
        first, last = column_spans(outline, *image.shape)
        # The level is taken from pixels that the blur of the opposite edge does not reach.
        kept = (last - first)[course.places] >= size + reach
        kept &= (middle >= size) & (middle < len(image) - size)
        course, middle = course.take(kept), middle[kept]
        if len(middle) < MIN_POINTS:
            return None
        inwards = 1 if course.leverage.sum() > 0.0 else -1
        pixels = np.arange(-size, size + 1)
        across = middle[:, None] + pixels * inwards
        light = seen.of(image[across, course.places[:, None]])
        if level:  # its innermost pixels show a column's light unless they are white
            inside = light[:, -_LEVEL_PIXELS:].mean(axis=1)
            lit = seen.true_inside(inside) - seen.true_outside(light[:, :_LEVEL_PIXELS].mean())
            lit = np.where(seen.is_white(inside), self.own.light[course.places], lit)[:, None]
            brightest = np.percentile(lit, 95)
        else:
            lit, brightest = self.own.at(course.places, across), np.percentile(self.own.light, 99)
        depth = pixels - ((course.across - middle) * inwards)[:, None]
        found = _PixelsAcross(
            course, inwards, depth, light, np.broadcast_to(lit, light.shape),
            max(_MIN_RELATIVE_LIGHT * float(brightest), 0.0), seen, self.blur,
        )  # fmt: skip
        return found.correct_level()


@dataclass(frozen=True, eq=False)
class _PixelsAcross:
    """The pixels across an edge for each of its points, from outside to inside.

    All arrays have the shape (points, pixels).
    """

    course: Course
    inwards: int  # 1 if rows or columns inside have larger numbers, otherwise -1
    depth: FloatArray  # pixels along the axis from the course
    light: FloatArray  # light as it appears
    lit: FloatArray  # the lamp's true light above the dark, as if it had no edge
    bright: float  # the true light from which an edge is measured
    seen: ApparentLight
    blur: float
    error: float = 0.0  # common error of all points' light, in pixels of the lamp's light

    @cached_property
    def outside(self) -> float:
        """The light beside the lamp, as it appears."""
        return float(self.light[:, :_LEVEL_PIXELS].mean())

    @cached_property
    def own(self) -> FloatArray:
        """The lamp's light above that outside, as it appears far from any edge."""
        black = self.seen.true_outside(self.outside)
        return self.seen.inside(black + self.lit) - self.outside

    def expect(self, shift: float = 0.0) -> FloatArray:
        """Return the expected light of an edge that is ``shift`` pixels further inside."""
        depth, black, own = self.depth - shift, self.seen.true_outside(self.outside), self.own
        if self.blur < _SHARP:
            return np.asarray(self.outside + np.clip(depth + 0.5, 0.0, 1.0) * own)
        across = depth / self.course.steepness[:, None]
        covered = normal_fraction(across / self.blur)
        true = black + covered * self.lit
        seen = np.where(covered < 0.5, self.seen.outside(true), self.seen.inside(true))
        # The edge may be anywhere on the grid of pixels.
        on_grid = math.hypot(self.blur, _OF_PIXEL / float(self.course.steepness.mean()))
        return np.asarray(seen + (normal_fraction(across / on_grid) - covered) * own)

    def correct_level(self) -> Self | None:
        """Correct the lamp's light by the pixels inside the edge; None if there are too few.

        The light falls towards the rim, so the level is extrapolated to the lit pixels of the sum.
        """
        inner = np.s_[:, -_LEVEL_PIXELS:]
        dark = self.light[:, :_LEVEL_PIXELS].mean(axis=0)
        is_bright = self.lit[inner] > self.bright
        shows = is_bright.sum(axis=0) >= _MIN_LEVEL_POINTS
        reach = self.light.shape[1] // 2 - _LEVEL_PIXELS
        places = reach + 1.0 + np.flatnonzero(shows)
        if len(places) < _MIN_LEVEL_PIXELS:
            return None
        level, whole = (
            np.where(is_bright, light[inner] - self.outside, 0.0).sum(axis=0)[shows]
            for light in (self.light, self.expect())
        )
        if whole.min() <= 0.0:
            return None
        level = level / whole
        apart = places - places.mean()
        slope, gain = np.polyfit(apart, level, 1).tolist()
        scatter = float((level - slope * apart).std()) * math.sqrt(len(places) / (len(places) - 2))
        back = float(places.mean()) - reach / 2.0
        spread = float(apart.std()) * math.sqrt(len(places))
        of_level = reach * math.hypot(1.0 / math.sqrt(len(places)), back / spread)
        of_dark = (2 * reach + 1) * float(dark.std()) / math.sqrt(_LEVEL_PIXELS)
        of_dark /= float(self.own[inner].max())
        at_edge = gain - slope * back
        if min(gain, at_edge) <= 0.0:
            return None
        error = math.hypot(scatter * of_level, of_dark) / gain
        return replace(self, lit=self.lit * at_edge, bright=self.bright * at_edge, error=error)

    def search_ends(self) -> FloatArray:
        """Return the edge's ends that explain both of its halves best, to a pixel."""
        few = self._take(slice(None, None, max(1, len(self.light) // _SEARCHED_POINTS)))
        reach = self.light.shape[1] // 2 - _LEVEL_PIXELS
        shifts = np.arange(-reach, reach + 1)
        errors = np.array(
            [np.square(few.light - few.expect(one)).sum(axis=1) for one in shifts.tolist()]
        )
        half = len(few.light) // 2
        first, second = (
            shifts[part.sum(axis=1).argmin()] for part in (errors[:, :half], errors[:, half:])
        )
        place = np.linspace(-0.5, 1.5, len(self.light))  # 0 and 1 in the middles of the halves
        line = Line(self.course, self.inwards * (first + place * (second - first)), _NOTHING)
        return self.course.move(line.shift)

    def _take(self, points: slice) -> Self:
        return replace(
            self, course=self.course.take(points), depth=self.depth[points],
            light=self.light[points], lit=self.lit[points],
        )  # fmt: skip

    def fit_line(self) -> Line | None:
        """Find each point from the light summed across it, and fit a line."""
        summed = np.s_[:, _LEVEL_PIXELS:-_LEVEL_PIXELS]
        total, expected, nearer, farther = (
            light[summed].sum(axis=1)
            for light in (self.light, self.expect(), self.expect(-0.5), self.expect(0.5))
        )
        middle = self.light.shape[1] // 2
        valid = self.lit[:, middle - 1 : middle + 2].min(axis=1) > self.bright
        a_pixel = np.maximum(nearer - farther, 1e-12)
        off = self.inwards * (expected - total) / a_pixel
        return fit_line(self.course.take(valid), off[valid], self.error, self.blur)

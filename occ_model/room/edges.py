"""Measure the straight edges of a rectangular lamp in a picture to a fraction of a pixel.

Dark chips hide a lamp's edge. It is therefore measured only where the lamp's light, which repeats
with the packet, is bright.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.normal import normal_fraction
from occ_model.effects.distortion import subdivide
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
_BLUR_REACH = 3.0  # standard deviations of the lens's blur over which light is also summed
_LEVEL_PIXELS = 10  # further pixels, which give the levels of lamp and surroundings
_MIN_RELATIVE_LIGHT = 0.5  # fraction of the lamp's brightest light from which an edge is measured

_MIN_LEVEL_PIXELS = 4  # minimum pixels across an edge that determine the level inside
_MIN_LEVEL_POINTS = 8  # minimum number of bright points for each of them
_MAX_PASSES = 6  # over a side, each around the line of the previous pass
_CONVERGED = 0.2  # pixels up to which a line agrees with the course around which it was measured
_PIXEL_BLUR = math.sqrt(1.0 / 12.0)  # standard deviation of the blur by a pixel's own width
_SHARP = 0.3  # standard deviation in pixels of a blur below which no pixel is partly lit
_SEARCHED_POINTS = 64  # number of an edge's points used to search for it
_SAMPLES = 16  # of each side's curve in the lamp's outline


def find_edges(image: ByteArray, room: Room, lamp: RoomLamp, corners: FloatArray) -> list[Edge]:
    """Measure a lamp's edges.

    ``corners``: the corners of its outline as a lens without distortion would show them, shape (4,
    2).
    """
    outline = distort_points(subdivide(corners, np.full(4, _SAMPLES)), room.scene)
    enhancement = find_enhancement(lamp, room, _take_middle(image, outline))
    apparent, blur = ApparentLight(room.scene, enhancement), _find_blur(lamp, corners, room.scene)
    # The outline is where the light is a tenth; the margin also excludes the blurred rim.
    margin = _EDGE_REACH + math.ceil(1.5 * _BLUR_REACH * blur)
    lamp_light = LampLight.of(image, outline, lamp, apparent, margin)
    lamp_in_picture = _LampInPicture(image, room.scene, outline, apparent, lamp_light, blur)
    lines = [lamp_in_picture.fit_line(corners[[side, (side + 1) % 4]]) for side in range(4)]
    measured = [line for line in lines if line is not None]
    variance_ratio = estimate_variance_ratio(measured)
    return [line.make_edge(variance_ratio) for line in measured]


def _take_middle(image: ByteArray, outline: FloatArray) -> ByteArray:
    """Return the pixels well within an outline, in no particular order."""
    centre = outline.mean(axis=0)
    first, last = column_spans(centre + 0.5 * (outline - centre), *image.shape)
    columns = np.flatnonzero(last > first).tolist()
    return np.concatenate(
        [image[:0, 0], *(image[first[column] : last[column], column] for column in columns)]
    )


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
    apparent: ApparentLight
    lamp_light: LampLight
    blur: float

    def fit_line(self, ends: FloatArray) -> Line | None:
        """Measure an edge around its expected course, then repeatedly around the fitted line."""
        pixels = self._take_across(Course.of(ends, self.scene))
        if pixels is None:
            return None
        ends = pixels.search_ends()
        for _ in range(_MAX_PASSES):
            pixels = self._take_across(Course.of(ends, self.scene))
            line = None if pixels is None else pixels.fit_line()
            if line is None or np.abs(line.shift).max() < _CONVERGED:
                return line
            ends = line.course.move(line.shift)
        return None

    def _take_across(self, course: Course) -> "_PixelsAcross | None":
        """Return the pixels across an edge; None if too few of its points have enough pixels."""
        is_level, apparent = course.axis == 0, self.apparent
        image, outline = (
            (self.image, self.outline) if is_level else (self.image.T, self.outline[:, ::-1])
        )
        steepest = float(course.steepness.max(initial=1.0))
        reach = max(_EDGE_REACH, math.ceil(_BLUR_REACH * self.blur * steepest))
        size = reach + _LEVEL_PIXELS
        course = course.cut_ends(size - 2)
        middle = np.rint(course.across).astype(np.int64)
        first, last = column_spans(outline, *image.shape)
        # The level is taken from pixels that the blur of the opposite edge does not reach.
        is_clear = (last - first)[course.places] >= size + reach
        is_clear &= (middle >= size) & (middle < len(image) - size)
        course, middle = course.take(is_clear), middle[is_clear]
        if len(middle) < MIN_POINTS:
            return None
        inwards = 1 if course.leverage.sum() > 0.0 else -1
        pixels = np.arange(-size, size + 1)
        across = middle[:, None] + pixels * inwards
        light = apparent.of(image[across, course.places[:, None]])
        if is_level:  # its innermost pixels show a column's light unless they are white
            inside = light[:, -_LEVEL_PIXELS:].mean(axis=1)
            lamp_levels = apparent.true_inside(inside) - apparent.true_outside(
                light[:, :_LEVEL_PIXELS].mean()
            )
            lamp_levels = np.where(
                apparent.is_white(inside), self.lamp_light.light[course.places], lamp_levels
            )[:, None]
            brightest = np.percentile(lamp_levels, 95)
        else:
            lamp_levels, brightest = (
                self.lamp_light.at(course.places, across),
                np.percentile(self.lamp_light.light, 99),
            )
        depth = pixels - ((course.across - middle) * inwards)[:, None]
        edge_pixels = _PixelsAcross(
            course, inwards, depth, light, np.broadcast_to(lamp_levels, light.shape),
            max(_MIN_RELATIVE_LIGHT * float(brightest), 0.0), apparent, self.blur,
        )  # fmt: skip
        return edge_pixels.correct_level()


@dataclass(frozen=True, eq=False)
class _PixelsAcross:
    """The pixels across an edge for each of its points, from outside to inside.

    All arrays have the shape (points, pixels).
    """

    course: Course
    inwards: int  # 1 if rows or columns inside the lamp have larger numbers, otherwise -1
    depth: FloatArray  # distance inwards from the course, in pixels
    light: FloatArray  # light as it appears
    lit: FloatArray  # the lamp's true light above the dark, as if it had no edge
    bright: float  # the minimum true light at which an edge is measured
    apparent: ApparentLight
    blur: float
    error: float = 0.0  # common error of all points' light, in pixels of the lamp's light

    @cached_property
    def outside(self) -> float:
        """The light beside the lamp, as it appears."""
        return float(self.light[:, :_LEVEL_PIXELS].mean())

    @cached_property
    def apparent_lamp(self) -> FloatArray:
        """The lamp's light, less that outside, as it appears far from any edge."""
        black = self.apparent.true_outside(self.outside)
        return self.apparent.inside(black + self.lit) - self.outside

    def expect(self, shift: float = 0.0) -> FloatArray:
        """Return the expected light of an edge that is ``shift`` pixels further inside."""
        depth, black, apparent_lamp = (
            self.depth - shift,
            self.apparent.true_outside(self.outside),
            self.apparent_lamp,
        )
        if self.blur < _SHARP:
            return np.asarray(self.outside + np.clip(depth + 0.5, 0.0, 1.0) * apparent_lamp)
        across = depth / self.course.steepness[:, None]
        lit_fraction = normal_fraction(across / self.blur)
        true_light = black + lit_fraction * self.lit
        apparent = np.where(
            lit_fraction < 0.5, self.apparent.outside(true_light), self.apparent.inside(true_light)
        )
        # The edge may be at any position on the pixel grid.
        total_blur = math.hypot(self.blur, _PIXEL_BLUR / float(self.course.steepness.mean()))
        return np.asarray(
            apparent + (normal_fraction(across / total_blur) - lit_fraction) * apparent_lamp
        )

    def correct_level(self) -> Self | None:
        """Correct the lamp's light by the pixels inside the edge; None if there are too few.

        The light decreases towards the rim, so the level is extrapolated to the summed pixels.
        """
        inner = np.s_[:, -_LEVEL_PIXELS:]
        dark = self.light[:, :_LEVEL_PIXELS].mean(axis=0)
        is_bright = self.lit[inner] > self.bright
        has_points = is_bright.sum(axis=0) >= _MIN_LEVEL_POINTS
        reach = self.light.shape[1] // 2 - _LEVEL_PIXELS
        distances = reach + 1.0 + np.flatnonzero(has_points)
        if len(distances) < _MIN_LEVEL_PIXELS:
            return None
        level, expected = (
            np.where(is_bright, light[inner] - self.outside, 0.0).sum(axis=0)[has_points]
            for light in (self.light, self.expect())
        )
        if expected.min() <= 0.0:
            return None
        level = level / expected
        centred = distances - distances.mean()
        slope, gain = np.polyfit(centred, level, 1).tolist()
        scatter = float((level - slope * centred).std()) * math.sqrt(
            len(distances) / (len(distances) - 2)
        )
        extrapolation = float(distances.mean()) - reach / 2.0
        spread = float(centred.std()) * math.sqrt(len(distances))
        level_error = reach * math.hypot(1.0 / math.sqrt(len(distances)), extrapolation / spread)
        dark_error = (2 * reach + 1) * float(dark.std()) / math.sqrt(_LEVEL_PIXELS)
        dark_error /= float(self.apparent_lamp[inner].max())
        edge_gain = gain - slope * extrapolation
        if min(gain, edge_gain) <= 0.0:
            return None
        error = math.hypot(scatter * level_error, dark_error) / gain
        return replace(self, lit=self.lit * edge_gain, bright=self.bright * edge_gain, error=error)

    def search_ends(self) -> FloatArray:
        """Return the ends for which both halves of the edge fit best, to a pixel."""
        sample = self._take(slice(None, None, max(1, len(self.light) // _SEARCHED_POINTS)))
        reach = self.light.shape[1] // 2 - _LEVEL_PIXELS
        shifts = np.arange(-reach, reach + 1)
        errors = np.array(
            [
                np.square(sample.light - sample.expect(shift)).sum(axis=1)
                for shift in shifts.tolist()
            ]
        )
        half = len(sample.light) // 2
        first, second = (
            shifts[half_errors.sum(axis=1).argmin()]
            for half_errors in (errors[:, :half], errors[:, half:])
        )
        position = np.linspace(-0.5, 1.5, len(self.light))  # 0 and 1 in the middles of the halves
        line = Line(self.course, self.inwards * (first + position * (second - first)))
        return self.course.move(line.shift)

    def _take(self, points: slice) -> Self:
        return replace(
            self, course=self.course.take(points), depth=self.depth[points],
            light=self.light[points], lit=self.lit[points],
        )  # fmt: skip

    def fit_line(self) -> Line | None:
        """Find each point from the light summed across it, and fit a line."""
        across = np.s_[:, _LEVEL_PIXELS:-_LEVEL_PIXELS]
        total, expected, outer, inner = (
            light[across].sum(axis=1)
            for light in (self.light, self.expect(), self.expect(-0.5), self.expect(0.5))
        )
        middle = self.light.shape[1] // 2
        valid = self.lit[:, middle - 1 : middle + 2].min(axis=1) > self.bright
        light_per_pixel = np.maximum(outer - inner, 1e-12)
        offsets = self.inwards * (expected - total) / light_per_pixel
        return fit_line(self.course.take(valid), offsets[valid], self.error, self.blur)

"""How much leaving effects out changes what is observed of a scene, estimated from a sample.

The pixels of a sample are computed with all effects and without each; columns cost microseconds.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import (
    FLAT,
    WHITE,
    ColumnLight,
    luminance_of,
    panel_values,
    pixel_value,
    saturate,
    surroundings_values,
)
from occ_model.camera.projection import geometry_of
from occ_model.camera.row_memory import MEMORY
from occ_model.camera.sensor import saturation_value
from occ_model.effects.effect import (
    Effect,
    FileEffect,
    LightEffect,
    NoiseEffect,
    OpticsEffect,
    PixelEffect,
)
from occ_model.effects.file_change import FileChange
from occ_model.effects.normal import clipped_mean, share_unclipped
from occ_model.effects.paper_view import PaperView
from occ_model.effects.sample import Sample, sample_of
from occ_model.scene.simulation_settings import Observable

_LEVELS = 129

_DOUBTED = 1.0
"""Pixels of a rim that may change and that no sample shows."""

_DOUBTED_RIM, _DOUBTED_RIM_OF_FEW = 0.5, 1.0
"""Part of the pixels of a rim that moves of which no sample shows whether they are enhanced: in
many columns, and in few."""

_UNSURE = 0.25
"""Share of a mean square by which a file without noise may change it further."""

_FLUCTUATION = 4.0
"""Standard deviations by which few pixels that are rounded otherwise may exceed their mean."""

_BETWEEN = 0.02
"""Grey levels from the middle between two levels within which rounding cannot be foretold."""

_MIDDLE = 0.15
"""Share of a chip from its middle at which it is read."""

_SEEN_SHARE = 0.003
"""Change of a pixel's light from beyond a rim that can round it otherwise."""

_LARGE_STEP = 32.0
"""Levels by which an enhancement can part neighbouring levels, so that one column matters."""

_FEW = 3
"""Sampled columns near a large step from which the sample shows what happens there."""

_WIDE = 8.0
"""Noise in grey levels that black and white cut off noticeably."""

_SHARP = 0.5
"""Noise in grey levels below which the enhancement's steps show between the levels."""


class _Light:
    """The columns' values with some effects on the light."""

    def __init__(self, view: PaperView, effects: Iterable[LightEffect]) -> None:
        scene, light = view.scene, view.light
        for effect in effects:
            light = effect.apply(scene, light)
        self.light: ColumnLight = light
        self.panel = view.values if light is view.light else panel_values(scene, light)
        self.surroundings = np.broadcast_to(surroundings_values(scene, light), self.panel.shape)


class Changes:
    """What leaving effects out changes: see the module."""

    def __init__(self, view: PaperView, effects: Iterable[Effect]) -> None:
        self._view = view
        self._scene = view.scene
        self.effects = tuple(effect for effect in effects if effect.is_present(view.scene))
        self.names = frozenset(effect.name for effect in self.effects)
        self._lights = [e for e in self.effects if isinstance(e, LightEffect)]
        self._lenses = [e for e in self.effects if isinstance(e, OpticsEffect)]
        self._limits = [e for e in self.effects if isinstance(e, PixelEffect)]
        self.noises = [e for e in self.effects if isinstance(e, NoiseEffect)]
        self._files = [e for e in self.effects if isinstance(e, FileEffect)]
        self.means = [*self._lights, *self._lenses, *self._limits]
        self._light_of: dict[frozenset[str], _Light] = {}
        self._values_of: dict[frozenset[str], FloatArray] = {}
        self._place_of: dict[int, tuple[FloatArray, tuple[IndexArray, FloatArray]]] = {}
        self._enhancement_of: dict[frozenset[str], Enhancement] = {}
        self.sample = self._sampled()
        self._unit = float(pixel_value(np.ones(1), self._scene.camera)[0])
        power = 1.0 / self._scene.camera.gamma
        self._dimmed = {n: g**power for n, g in self.sample.transmission.items()}

    def _sampled(self) -> Sample:
        scene, view = self._scene, self._view
        transmitter = scene.transmitter
        key = (
            "effect sample",
            view.corners.tobytes(),
            scene.pose,
            scene.lens,
            *geometry_of(scene.camera),
            scene.camera.f_number,
            scene.sensor.pixel_pitch,
            transmitter.lambertian_order,
            tuple(effect.name for effect in self._lenses),
            bool(self._files),
        )

        def make() -> Sample:
            plain = Optics(view.corners)
            optics = {effect.name: effect.apply(scene, plain) for effect in self._lenses}
            level = view.sides is not None and view.is_seen
            return sample_of(view.region, level, optics, plain, bool(self._files))

        return MEMORY.recall(key, make, lambda made: made.arrays)

    def _light(self, included: frozenset[str]) -> _Light:
        chosen = [effect for effect in self._lights if effect.name in included]
        key = frozenset(effect.name for effect in chosen)
        if key not in self._light_of:
            self._light_of[key] = _Light(self._view, chosen)
        return self._light_of[key]

    def values(self, included: frozenset[str]) -> FloatArray:
        """Return the pixels' mean values with some effects, shape (columns, nodes)."""
        included = included & frozenset(e.name for e in self.means)
        if included not in self._values_of:
            self._values_of[included] = self._computed(included)
        return self._values_of[included]

    def _computed(self, included: frozenset[str]) -> FloatArray:
        sample, camera = self.sample, self._scene.camera
        light = self._light(included)
        places = sample.columns
        panel = light.panel[places][:, None]
        cover = sample.covers[included & self._outline]
        emission = [gain for name, gain in sample.emission.items() if name in included]
        if cover is None and not emission:
            values = np.broadcast_to(panel, sample.rows.shape)
        else:
            surroundings = light.surroundings[places][:, None]
            dark = luminance_of(surroundings, camera)
            own = luminance_of(panel, camera) - dark
            for factor in [*emission, *([] if cover is None else [cover])]:
                own = own * factor
            values = pixel_value(np.maximum(dark + own, 0.0), camera)
        for name, gain in self._dimmed.items():
            if name in included:
                values = values * gain
        for limit in self._limits:
            if limit.name in included:
                values = limit.apply(self._scene, values)
        return np.minimum(values, WHITE)

    @cached_property
    def _outline(self) -> frozenset[str]:
        return max(self.sample.covers, key=len)

    # Noise -----------------------------------------------------------------------------------

    @cached_property
    def levels(self) -> FloatArray:
        """Levels from the darkest pixel of the sample to the brightest, with any effects."""
        found = [self.values(self.names), *(self.values(self.names - {e.name}) for e in self.means)]
        low = min(float(values.min()) for values in found)
        high = max(float(values.max()) for values in found)
        step = max(high - low, FLAT) / (_LEVELS - 3)
        full = saturation_value(self._scene)
        if low < full < high:  # where noise ends, a level of the table
            low -= step * (1.0 - (full - low) / step % 1.0)
        return np.asarray(low + step * np.arange(_LEVELS, dtype=np.float64), dtype=np.float64)

    @cached_property
    def variances(self) -> dict[str, FloatArray]:
        """The variance of each noise at the levels."""
        return {
            e.name: e.spread(self._scene, np.maximum(self.levels, 0.0)) ** 2 for e in self.noises
        }

    def spread(self, included: frozenset[str]) -> FloatArray:
        """Return the standard deviation of noise at the levels, with some effects."""
        own = [variance for name, variance in self.variances.items() if name in included]
        return np.sqrt(sum(own, np.zeros(_LEVELS)))

    def _look(self, table: FloatArray, values: FloatArray) -> FloatArray:
        below, share = self._place(values)
        steps = table[1:] - table[:-1]
        return np.asarray(table[below] + share * steps[below])

    def _place(self, values: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the level below each value, and how far the value lies towards the next one."""
        known = self._place_of.get(id(values))
        if known is not None and known[0] is values:
            return known[1]
        low, high = float(self.levels[0]), float(self.levels[-1])
        place = (values - low) * ((_LEVELS - 1) / (high - low))
        place = np.minimum(np.maximum(place, 0.0), _LEVELS - 1.001)
        below = place.astype(np.intp)
        found = below, place - below
        if any(values is kept for kept in self._values_of.values()):  # looked up again and again
            self._place_of[id(values)] = values, found
        return found

    @cached_property
    def _file(self) -> FileChange | None:
        """What the file makes of the pixels, None where the scene has none."""
        if not self._files:
            return None
        sample, view = self.sample, self._view
        return FileChange(
            self._files[0].steps(self._scene),
            sample.blocks,
            sample.inner,
            self.values(self.names),
            self._noise_with(self.names),
            view.region.rows / 8.0,
            self._rim_share,
        )

    def _noise_with(self, included: frozenset[str]) -> float:
        """Return the root mean square of noise on the panel with some effects."""
        whole = self.values(self.names)[:, self.sample.inner]
        return math.sqrt(float(self._look(self.spread(included) ** 2, whole).mean()))

    def _noise_without(self, name: str) -> tuple[float, float]:
        """Return the root mean square of a noise, and of all the other, on the panel."""
        return self._noise_with(frozenset({name})), self._noise_with(self.names - {name})

    # Observables -----------------------------------------------------------------------------

    def observed(self, observable: Observable) -> "Observed":
        """Return what is observed of the sample, and how it changes."""
        if observable == "image":
            found = self._image()
        else:
            found = self._profile() if observable == "profile" else self._signal()
        if self._file is not None:
            found.unsure = _UNSURE * self._file.undithered_share
            doubt = self._file.undithered()
            rims = self._rim_share  # where no noise spreads it, a rim's blocks round otherwise
            square = rims * max(self._view.swing, self._contrast) ** 2 / 64.0
            at_rims = self._file.undithered_share * self._file.added_at_rims(rims, square)
            doubt += at_rims if observable == "image" else at_rims / self._file.block_rows
            for name in self.names:
                found.doubt[name] = found.doubt.get(name, 0.0) + doubt
        return found

    def _image(self) -> "Observed":
        everything, file = self.names, self._file
        whole = self.values(everything)
        spread = self.spread(everything)
        slope = np.gradient(spread, self.levels)
        unclipped = share_unclipped(self.levels, spread, WHITE)
        # Where the light changes, its noise does; and pixels that are cut off change less.
        share = self._look(unclipped * (1.0 + slope**2), whole)
        weights = np.sqrt(np.maximum(share * self.sample.pixel_weights, 0.0)).ravel()

        def seen(included: frozenset[str]) -> FloatArray:
            return self.values(included).ravel() * weights

        found = Observed(everything, seen)
        pixels = self._view.region.rows * self._view.region.columns
        for name in self._outline & everything:
            found.doubt[name] = self._doubted_pixels(self._contrast**2 / pixels)
        for effect in self.effects:
            name = effect.name
            if effect in self.noises:
                variance = self._look(self.variances[name] * unclipped, whole)
                square = float((variance * self.sample.pixel_weights).sum())
                if file is not None:
                    square = file.of_noise(*self._noise_without(name))[0]
                found.alone[name] = square
            elif file is not None and effect in self._files:
                found.alone[name] = file.own_change()
            elif file is not None:
                plain = found.together(frozenset({name}))
                added = file.added(self.values(everything - {name}))[0]
                added += self._added_at_rims(name, plain)
                found.alone[name] = max(added, -0.5 * plain)
        return found

    @property
    def _rim_share(self) -> float:
        """The share of the region's pixels that lie in a file's blocks with a rim."""
        region, camera = self._view.region, self._scene.camera
        if self._view.sides is None:
            return min(1.0, 8.0 / region.rows + 8.0 / region.columns)
        ends = (region.first_row > 0) + (region.last_row < camera.rows)
        sides = (region.first_column > 0) + (region.last_column < camera.columns)
        return min(1.0, 4.0 * ends / region.rows + 4.0 * sides / region.columns)

    def _added_at_rims(self, name: str, plain: float) -> float:
        """Return what a file adds where an effect moves or softens the panel's rim."""
        if name not in self._outline or self._file is None:
            return 0.0
        ends = self._moved_rims(name) * 8.0 / self._view.region.rows
        if plain:
            return self._file.added_at_rims(min(ends, 1.0), plain)
        # A rim that moves outwards changes blocks that are observed in part.
        rims = self._rim_share
        return self._file.added_at_rims(rims, rims * self._view.swing**2 / 64.0)

    def _moved_rims(self, name: str) -> float:
        """Return how many rims of a column, 0 to 2, an effect moves or softens in the mean."""
        covers, sample = self.sample.covers, self.sample
        whole, without = covers[self._outline], covers[self._outline - {name}]
        if whole is None or without is None:
            return 0.0
        moved = np.abs(whole - without) > _SEEN_SHARE
        middle = sample.inner.start + 2
        above, below = moved[:, :middle].any(axis=1), moved[:, middle:].any(axis=1)
        return float(((above * 1.0 + below) * sample.weights).sum())

    @property
    def _contrast(self) -> float:
        """The difference of the brightest and the darkest pixel of the sample."""
        return float(self.levels[-1] - self.levels[0])

    def _doubted_pixels(self, square: float) -> float:
        """Return the mean square of a few pixels of a rim, of which a sample need not show any.

        A file spreads them over their block. A panel that covers all of the picture has no rim.
        """
        if self.sample.is_covered:
            return 0.0
        doubt = _DOUBTED * square
        if self._file is not None:
            pixels = self._view.region.rows * self._view.region.columns
            doubt += self._file.added_at_rims(min(64.0 / pixels, self._rim_share), doubt)
        return doubt

    def _mean_of_rows(self, seen: FloatArray) -> FloatArray:
        return np.asarray((seen * self.sample.row_weights).sum(axis=1))

    def _profile(self) -> "Observed":
        everything, sample, file = self.names, self.sample, self._file
        whole, rows = self.values(everything), self._view.region.rows
        weights = np.sqrt(sample.weights)

        def seen(included: frozenset[str]) -> FloatArray:
            spread = self.spread(included)
            if file is not None and self._files[0].name in included:
                spread = np.hypot(spread, math.sqrt(file.own_change()))
            table = clipped_mean(self.levels, spread, WHITE)
            return self._mean_of_rows(self._look(table, self._read_back(included))) * weights

        found = Observed(everything, seen)
        region = self._view.region
        for name in self._outline & everything:
            share = self._contrast**2 / (region.rows**2 * region.columns)
            found.doubt[name] = self._doubted_pixels(share)
        for effect in self.effects:
            name = effect.name
            if effect in self.noises:
                variance = self._look(self.variances[name], whole)
                part = float((self._mean_of_rows(variance) * sample.weights).sum()) / rows
                if file is not None:
                    part = file.of_noise(*self._noise_without(name))[1]
                found.alone[name] = part
            elif file is not None and effect in self._files:
                found.alone[name] = file.own_sampling()
                found.doubt[name] = found.together(frozenset({name}))
            elif file is not None:
                found.alone[name] = file.added(self.values(everything - {name}))[1]
        return found

    def _read_back(self, included: frozenset[str]) -> FloatArray:
        """Return the pixels' mean values, of a file as they are read back."""
        values = self.values(included)
        if self._file is None or self._files[0].name not in included:
            return values
        return self._file.means(values, self._noise_with(included))

    def _enhancement(self, included: frozenset[str]) -> Enhancement:
        key = included & frozenset(e.name for e in (*self._lights, *self._limits))
        if key not in self._enhancement_of:
            profile = self._light(included).panel
            for limit in self._limits:
                if limit.name in included:
                    profile = limit.apply(self._scene, profile)
            method = self._scene.model.enhancement
            self._enhancement_of[key] = Enhancement(saturate(profile), method)
        return self._enhancement_of[key]

    @property
    def signal_swing(self) -> float:
        """Largest less smallest value of the enhanced profile without effects, at least 1."""
        seen = saturate(self._view.values)
        enhanced = Enhancement(seen, self._scene.model.enhancement)(seen)
        return max(float(enhanced.max()) - float(enhanced.min()), FLAT)

    def _signal(self) -> "Observed":
        sample = self.sample
        weights = np.sqrt(sample.weights)
        levels = np.clip(self.levels, 0.0, WHITE)

        optics = frozenset(effect.name for effect in self._lenses)
        smooth: dict[frozenset[str], tuple[FloatArray, FloatArray]] = {}

        def curve(included: frozenset[str]) -> tuple[FloatArray, FloatArray]:
            spread = self.spread(included)
            if self._file is not None and self._files[0].name in included:
                spread = self._file.spread(spread)
            return self._enhancement(included).mean(levels, spread), spread

        def seen(included: frozenset[str]) -> FloatArray:
            values, key = self._read_back(included), included - optics
            if key not in smooth:
                smooth[key] = curve(included)
            mean, spread = smooth[key]
            if float(spread.max()) < _SHARP:
                flat = np.clip(values.ravel(), 0.0, WHITE)
                sharp = self._enhancement(included).mean(flat, self._look(spread, flat))
                smoothed = sharp.reshape(values.shape)
            else:
                smoothed = self._look(mean, values)
            inside = self._inside(included)
            if inside is not None:  # beside the panel nothing is enhanced
                smoothed = np.where(inside, smoothed, self._beside(included, values))
            return self._mean_of_rows(smoothed) * weights

        found = Observed(self.names, seen)
        found.alone.update(self._signal_sampling())
        region, contrast = self._view.region, float(np.ptp(found.complete / weights))
        method = self._scene.model.enhancement
        jump = contrast if method == "none" else WHITE
        few = len(sample.columns) >= region.columns
        part = _DOUBTED_RIM_OF_FEW if few else _DOUBTED_RIM
        for name in self._outline & self.names:
            share = contrast**2 / (region.rows**2 * region.columns)
            found.doubt[name] = self._doubted_pixels(share)
            # A pixel of a rim is enhanced or not.
            found.doubt[name] += self._moved_rims(name) * (part * jump / region.rows) ** 2
        self._doubt_sharp_steps(found)
        self._doubt_large_steps(found)
        self._doubt_a_cut_file(found)
        return found

    def _beside(self, included: frozenset[str], values: FloatArray) -> FloatArray:
        """Return the mean of pixels of some mean values that are rounded and not enhanced."""
        spread = self.spread(included)
        if float(spread.max()) < _SHARP:
            return np.rint(np.clip(values, 0.0, WHITE))
        return self._look(clipped_mean(self.levels, spread, WHITE), values)

    def _inside(self, included: frozenset[str]) -> NDArray[np.bool_] | None:
        """Return which pixels of the sample are the panel's, None where all are."""
        share = self.sample.covers[included & self._outline]
        return None if share is None else share >= 0.5

    def _doubt_sharp_steps(self, found: "Observed") -> None:
        """Doubt how pixels are rounded that no noise spreads over the enhancement's steps.

        Whole plateaus of values that lie between two levels may be rounded otherwise; in a file
        whatever its own error reaches, since that is alike in blocks of equal rows.
        """
        whole = np.clip(self.values(self.names), 0.0, WHITE)
        sharp = self._look(self.spread(self.names), whole) < _SHARP
        if not sharp.any():
            return
        enhancement = self._enhancement(self.names)
        if self._file is None:
            curve = enhancement.curve.astype(np.float64)
            below = np.minimum(whole, WHITE - 1.0).astype(np.int64)
            near = np.abs(whole - below - 0.5) < _BETWEEN
            reached = np.where(near, curve[below + 1] - curve[below], 0.0) / 2.0
        else:
            error = np.full(whole.size, math.sqrt(self._file.own_change()))
            reached = enhancement.moments(whole.ravel(), error)[1].reshape(whole.shape)
        square = self._mean_of_rows(np.where(sharp, reached, 0.0) ** 2)
        doubt = float((square * self.sample.weights).sum())
        for name in self.names:
            found.doubt[name] = found.doubt.get(name, 0.0) + doubt

    def _doubt_large_steps(self, found: "Observed") -> None:
        """Doubt columns near a large step of the enhancement that the sample does not have.

        An equalization makes one where many columns share a value. A change of less than their
        distance from it carries none of them across.
        """
        sample, region = self.sample, self._view.region
        if len(sample.columns) >= region.columns:
            return
        enhancement = self._enhancement(self.names)
        steps = np.diff(enhancement.curve.astype(np.float64))
        large = np.flatnonzero(steps > _LARGE_STEP)
        if not len(large):
            return
        profile = self._light(self.names).panel[region.first_column : region.last_column]
        for limit in self._limits:
            profile = limit.apply(self._scene, profile)
        away = np.abs(profile - large[:, None] - 0.5)
        sampled = away[:, sample.columns - region.first_column]
        for name in self.names:
            if name in self.variances:
                own, rest = self._noise_without(name)
                moved, share = own, min(0.5, (own / max(rest, _BETWEEN)) ** 2 / 8.0)
            else:
                without = self.values(self.names - {name})
                moved = math.sqrt(self._mean_of((self.values(self.names) - without) ** 2))
                share = min(0.5, 0.4 * moved / max(self._noise_with(self.names), _BETWEEN))
            near = max(moved, _BETWEEN)
            unseen = np.count_nonzero(sampled < near, axis=1) < _FEW
            doubt = (away < near).mean(axis=1)[unseen] @ (steps[large][unseen] * share) ** 2
            found.doubt[name] = found.doubt.get(name, 0.0) + float(doubt)

    def _doubt_a_cut_file(self, found: "Observed") -> None:
        """Doubt what a file makes of noise that black or white cuts off: it is not normal."""
        if self._file is None:
            return
        spread, name = self.spread(self.names), self._files[0].name
        lost = np.where(spread > _WIDE, 1.0 - share_unclipped(self.levels, spread, WHITE), 0.0)
        cut = self._mean_of(self._look(lost, self.values(self.names)))
        gain = float(np.ptp(found.complete / np.sqrt(self.sample.weights))) / self._view.swing
        doubt = cut * self._file.own_change() * min(gain, 8.0) ** 2 / 4.0
        found.doubt[name] = found.doubt.get(name, 0.0) + doubt

    def _mean_of(self, pixels: FloatArray) -> float:
        """Return the mean over all pixels."""
        return float((self._mean_of_rows(pixels) * self.sample.weights).sum())

    def _signal_sampling(self) -> dict[str, float]:
        """Return the mean square of what a mean of few rows deviates by, for each effect.

        A pixel that moves by d passes the curve's steps in proportion to d, which noise spreads
        over the rows. Where the steps are even, a change of a whole step passes no more than one.
        """
        everything, file = self.names, self._file
        whole, rows = self.values(everything), self._view.region.rows
        spread = self.spread(everything)
        levels = np.clip(self.levels, 0.0, WHITE)
        mean, deviation, jumps = self._enhancement(everything).smoothed(levels, spread)
        step = float(self.levels[1] - self.levels[0])
        even = np.gradient(mean, step) ** 2
        uneven = np.maximum(np.gradient(jumps, step) - even, 0.0)
        total = spread**2
        inside = self._inside(everything)
        one = 1.0 / (rows**2 * self._view.region.columns)
        pixel = self._mean_of(self._look(even + uneven, whole)) * one
        drawn = self._mean_of(self._look(even * total, whole)) * one
        found = {}
        for effect in self.effects:
            name, linear, moves_few = effect.name, 0.0, True
            if effect in self.noises:
                own = np.sqrt(self.variances[name])
                moves_few = float(own.max()) < 0.5 * float(spread.max())
                if file is not None:
                    read, linear = file.of_noise(*self._noise_without(name))
                    own = np.maximum(own, math.sqrt(read))
                part = even * (own**2 + np.tanh(4.8 * own) / 6.0) + uneven * 0.8 * own
                part = np.where(own**2 > 0.7 * total, deviation**2, np.minimum(part, deviation**2))
                part = self._look(part, whole)
                if inside is not None:
                    part = np.where(inside, part, self._look(own**2, whole))
            elif file is not None and effect in self._files:
                linear, moves_few = file.own_sampling(), False
                moved = min(math.sqrt(file.own_change()), 1.0)
                part = self._look(even / 6.0 + uneven * 0.8 * moved, whole)
            else:
                without = self.values(everything - {name})
                change = np.abs(whole - without)
                if file is not None:
                    added, linear = file.added(without)
                    change = np.sqrt(change**2 + max(added, 0.0))
                change = np.minimum(change, 0.5)
                part = self._look(even, whole) * change * (1.0 - change)
                part = part + self._look(uneven, whole) * change
            if linear:
                part = part + linear * rows * self._look(even, whole)
            found[name] = self._mean_of(part) / rows
            if effect in self.noises:  # one pixel whose noise is drawn otherwise
                found[name] += drawn
            if moves_few:
                found[name] += _FLUCTUATION * math.sqrt(found[name] * pixel)
        return found

    # The decision ----------------------------------------------------------------------------

    def margins(self, signal: "Observed") -> tuple[float, float]:
        """Return how far chips keep from the threshold, and the steps between columns near it.

        Both in levels of the signal. A chip that passes the threshold is read wrongly; where the
        signal crosses it, noise larger than the step between columns makes runs that are none.
        """
        scene, sample = self._scene, self.sample
        seen = signal.complete / np.sqrt(sample.weights)
        low, high = float(seen.min()), float(seen.max())
        camera, frequency = scene.camera, scene.transmitter.switching_frequency
        middle = scene.model.start_time + sample.columns * camera.readout_time
        phase = (middle + camera.exposure_time / 2.0) * frequency % 1.0
        chips = seen[np.abs(phase - 0.5) < _MIDDLE]
        if high - low < 1.0 or not len(chips):
            return 0.0, 0.0
        scaled = ((seen - low) * (WHITE / (high - low))).astype(np.uint8)
        found, _ = cv2.threshold(scaled[None, :], 0, 255, cv2.THRESH_OTSU)
        threshold = low + (found + 0.5) * (high - low) / WHITE
        across = max(camera.exposure_time / camera.readout_time, 1.0)
        return float(np.abs(chips - threshold).min()), (high - low) / across

    def is_like_noise(self, name: str) -> bool:
        """Return whether what an effect changes differs from column to column."""
        return any(effect.name == name for effect in (*self.noises, *self._files))


class Observed:
    """What is observed of a sample, and how it changes without some of the effects.

    What effects change adds as it is, with its sign, where it is the same in every picture; what
    noise and a file's rounding change is independent, and its mean squares add.

    Parameters
    ----------
    names
        All effects of the scene.
    seen
        Gives what is observed with some of them, each value times the root of its weight.

    Attributes
    ----------
    alone
        The mean square of what is independent in an effect's change, by name.
    doubt
        The mean square of what the sample may not show of it, by name.
    unsure
        Share by which any mean square may be larger.
    """

    def __init__(self, names: frozenset[str], seen: Callable[[frozenset[str]], FloatArray]) -> None:
        self._names = names
        self._seen = seen
        self.alone: dict[str, float] = {}
        self.doubt: dict[str, float] = {}
        self.unsure = 0.0
        self.complete = seen(names)
        self._moved = {name: self.complete - seen(names - {name}) for name in sorted(names)}

    def together(self, left_out: frozenset[str]) -> float:
        """Return the mean square of what leaving out some effects together changes."""
        if not left_out:
            return 0.0
        if len(left_out) == 1:
            (name,) = left_out
            change = self._moved[name]
        else:
            change = self.complete - self._seen(self._names - left_out)
        independent = sum(self.alone.get(name, 0.0) for name in left_out)
        doubt = max(self.doubt.get(name, 0.0) for name in left_out)
        return max(float(change @ change) + independent, 0.0) * (1.0 + self.unsure) + doubt

    def of_subsets(self, names: Sequence[str], members: FloatArray) -> FloatArray:
        """Return about the same for many sets of effects, as if their changes added.

        Parameters
        ----------
        names
            Effects.
        members : ndarray of float64, shape (sets, effects)
            1 where a set has an effect.
        """
        moved = np.stack([self._moved[name] for name in names])
        alone = np.array([self.alone.get(name, 0.0) for name in names])
        doubt = np.array([self.doubt.get(name, 0.0) for name in names])
        products = moved @ moved.T
        squares = np.einsum("si,ij,sj->s", members, products, members, optimize=True)
        sure = np.maximum(squares + members @ alone, 0.0)
        return np.asarray(sure * (1.0 + self.unsure) + (members * doubt).max(axis=1))

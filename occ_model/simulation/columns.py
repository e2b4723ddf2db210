"""The columns' pixel values, as far as all rows are equal: light, exposure and full pixels.

If no planned effect makes rows differ, this is the whole simulation, the profile path. Otherwise
the columns' means are added up some rows at a time.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.photometry import panel_values, saturate, surroundings_values
from occ_model.camera.picture_rows import PanelPart
from occ_model.effects.effect import LightEffect, PaperView
from occ_model.effects.noise import enhancement_of, law_of
from occ_model.effects.registry import effects_named
from occ_model.effects.sensor_effects import FullWell
from occ_model.results.frame import Plan
from occ_model.simulation.stage_timer import StageTimer


@dataclass(frozen=True, eq=False, slots=True)
class Columns:
    # Shape (columns,): pixel values on the panel and beside it, before dimming by a lens and
    # saturation
    panel: FloatArray
    surroundings: FloatArray
    # Shape (columns,): the same after saturation; ``profile`` is PV_sim
    profile: FloatArray
    around: FloatArray
    law: GreyLaw | None  # The law of the pixels' grey levels; None without noise
    enhancement: Enhancement  # Of the panel, by the histogram of its pixels


def expose_columns(view: PaperView, chosen: Plan, timer: StageTimer | None = None) -> Columns:
    timer = timer or StageTimer()
    scene, light, panel = view.scene, view.light, view.values
    for effect in effects_named(chosen.included, LightEffect):
        light = effect.apply(scene, light)
        timer.end_stage(effect.name)
    if light is not view.light:
        panel = panel_values(scene, light)
    surroundings = np.broadcast_to(surroundings_values(scene, light), panel.shape)
    profile, around = panel, surroundings
    timer.end_stage("exposure")
    for limit in effects_named(chosen.included, FullWell):
        profile, around = limit.apply(scene, profile), limit.apply(scene, around)
        timer.end_stage(limit.name)
    profile, around = saturate(profile), saturate(around)
    law = law_of(scene, chosen.included, panel, surroundings)
    enhancement = enhancement_of(scene, profile, panel, law)
    timer.end_stage("enhancement")
    return Columns(panel, surroundings, profile, around, law, enhancement)


class ColumnMeans:
    def __init__(self, columns: int) -> None:
        self._sums = np.zeros(columns)
        self._counts = np.zeros(columns, dtype=np.int64)

    def add(self, panel: PanelPart, values: Pixels | ByteArray) -> None:
        """Add the panel's pixels in some rows, in grey levels."""
        for columns in panel.inside:
            self._sums[columns] += _column_sums(values[:, columns])
            self._counts[columns] += len(values)
        for columns, inside in panel.rims:
            seen = np.where(inside, values[:, columns], values.dtype.type(0))
            self._sums[columns] += _column_sums(seen)
            self._counts[columns] += np.count_nonzero(inside, axis=0)

    def include(self, other: "ColumnMeans") -> None:
        self._sums += other._sums
        self._counts += other._counts

    def means(self, otherwise: FloatArray) -> FloatArray:
        means = self._sums / np.maximum(self._counts, 1)
        return np.asarray(np.where(self._counts > 0, means, otherwise))


def _column_sums(values: Pixels | ByteArray) -> FloatArray:
    # Summing bytes as integers is many times faster; a picture has too few rows to exceed 32 bits.
    exact = cv2.CV_32S if values.dtype == np.uint8 else cv2.CV_64F
    sums = cv2.reduce(values, 0, cv2.REDUCE_SUM, dtype=exact)
    return np.asarray(sums[0], dtype=np.float64)

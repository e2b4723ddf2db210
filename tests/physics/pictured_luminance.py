"""The light of each pixel with one effect of the optics."""

import numpy as np

import occ_model as occ
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import ColumnLight, luminance_of, panel_values, surroundings_values
from occ_model.camera.picture_rows import LitPanel, PictureRows, split_into_blocks
from occ_model.effects.effect import OpticsEffect
from occ_model.scene.scene import Scene


def picture_rows(scene: Scene, effect: OpticsEffect) -> PictureRows:
    """Return the rows of a picture with one effect of the optics."""
    optics = effect.apply(scene, Optics(occ.panel_corners(scene)))
    light = ColumnLight.of(scene)
    panel = panel_values(scene, light)
    around = np.broadcast_to(surroundings_values(scene, light), panel.shape)
    return PictureRows(scene.camera, [LitPanel(optics, panel)], around)


def pictured_luminance(scene: Scene, effect: OpticsEffect) -> np.ndarray:
    """Return the luminance of each pixel, shape (rows, columns)."""
    rows, blocks = picture_rows(scene, effect), range(scene.camera.rows)
    parts = [rows.of(block).values for block in split_into_blocks(blocks, scene.camera.columns)]
    return luminance_of(np.concatenate(parts), scene.camera)

"""Effects of angle and focus: directed emission, vignetting, defocus."""

import math
from dataclasses import replace

import cv2
import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.optics import Gain, Optics
from occ_model.camera.projection import geometry_of, pixel_rays, rotation_of
from occ_model.effects.effect import Cost, OpticsEffect
from occ_model.scene.scene import Scene


class Emission(OpticsEffect):
    """The panel's intensity falls as cos^m of the angle to its normal.

    Its luminance, the intensity divided by the visible area, falls as cos^(m - 1): a Lambertian
    panel, m = 1, is equally bright from all sides (J. M. Kahn and J. R. Barry, "Wireless infrared
    communications", Proc. IEEE 85, 1997, for the generalized Lambertian source). External light
    that the panel reflects does not change.
    """

    name = "emission"
    label = "Bundled emission"
    parameters = ("lambertian_order",)
    cost = Cost(pixels=0.8e-3)

    def is_present(self, scene: Scene) -> bool:
        return scene.transmitter.lambertian_order != 1.0

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        power = scene.transmitter.lambertian_order - 1.0
        normal = rotation_of(scene.pose)[:, 2]
        across, _ = pixel_rays(scene.camera, np.zeros(1))

        def gain(rows: FloatArray, columns: slice) -> Pixels:
            _, y = pixel_rays(scene.camera, rows)
            cosines = np.abs(_cosine(normal, across[:, columns], y)).astype(np.float32)
            return np.asarray(cv2.pow(np.minimum(cosines, np.float32(1.0)), power))

        factor = Gain.with_cache(
            self.name, (power, *normal.tolist(), *geometry_of(scene.camera)), gain
        )
        return replace(optics, emission=(*optics.emission, factor))


def _cosine(normal: FloatArray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the cosine of the angle between a normal and rays (x, y, 1), either sign."""
    along = normal[0] * x + normal[1] * y + normal[2]
    return np.asarray(along / np.sqrt(1.0 + x * x + y * y))


class Vignetting(OpticsEffect):
    """The light at a pixel falls as cos^n of its angle to the optical axis.

    n = 4 is the natural fall-off of a thin lens without distortion (W. J. Smith, *Modern Optical
    Engineering*); lenses corrected for it have less. On the axis nothing is lost. The angle is that
    of a lens without distortion.
    """

    name = "vignetting"
    label = "Vignetting"
    parameters = ("vignetting_exponent",)
    cost = Cost(pixels=1.2e-3)

    def is_present(self, scene: Scene) -> bool:
        return scene.lens.vignetting_exponent != 0.0

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        power = -scene.lens.vignetting_exponent / 2.0
        across, _ = pixel_rays(scene.camera, np.zeros(1))
        across = 1.0 + across * across

        def gain(rows: FloatArray, columns: slice) -> Pixels:
            _, y = pixel_rays(scene.camera, rows)
            return np.asarray(cv2.pow(across[:, columns] + y * y, power), dtype=np.float32)

        factor = Gain.with_cache(self.name, (power, *geometry_of(scene.camera)), gain)
        return replace(optics, transmission=(*optics.transmission, factor))


_LARGEST_SPREAD = 1e12
"""Largest point spread in pixels, which blurs any panel beyond recognition."""


class Defocus(OpticsEffect):
    """A Gaussian point spread: the lens's own spot, and the circle of confusion when out of focus.

    A lens of focal length f and f-number N, focused at d_f, images a point at the distance d as a
    disc of diameter c = f^2 / N |1/d_f - 1/d|, for d and d_f far beyond f (S. F. Ray, *Applied
    Photographic Optics*). A disc of diameter c has the standard deviation c / 4 along each axis,
    and the variances of disc and spot add. Inside an evenly bright panel a pixel receives as much
    light from its neighbours as it loses to them, so that only the panel's rim softens. The shutter
    makes the stripes behind the lens, and they stay sharp.
    """

    name = "defocus"
    label = "Defocus and point spread"
    parameters = ("point_spread", "focus_distance", "pixel_pitch")
    cost = Cost(picture=1e-3)

    def is_present(self, scene: Scene) -> bool:
        return blur_of(scene) != 0.0

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        return replace(optics, blur=blur_of(scene), cover_stage=self.name)


def blur_of(scene: Scene) -> float:
    """Return the standard deviation of the point spread in pixels."""
    camera, lens, distance = scene.camera, scene.lens, scene.pose.distance
    spot = 0.0
    if lens.focus_distance:
        focal = camera.focal_length_pixels
        vergence = 1.0 / lens.focus_distance - 1.0 / distance
        spot = focal * focal * scene.sensor.pixel_pitch / camera.f_number * vergence / 4.0
    return min(math.hypot(lens.point_spread, spot), _LARGEST_SPREAD)

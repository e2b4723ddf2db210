"""Panels and lenses in hard places: generated poses, lens coefficients and a small scene."""

import math

import numpy as np
from hypothesis import strategies as st

from hard_cases.references import decades, signed_decades, within
from occ_model.camera.projection import rotation_of
from occ_model.scene.scene import Scene

STEEP = math.radians(89.99)
ANGLES = st.floats(-STEEP, STEEP) | st.sampled_from([0.0, STEEP, -STEEP])
POSES = "d 1 mm to 10 km, panels 0.1 mm to 100 m, turned to 89.99 degrees"
GEOMETRY = {"sensor-noise": False, "fixed-pattern": False, "distortion": True, "defocus": True}


@st.composite
def poses(draw: st.DrawFn) -> Scene:
    """A panel of any size anywhere before a small picture, the lens and the light as they are."""
    distance = draw(decades(1e-3, 1e4))
    size = decades(1e-3, 1e4).map(lambda share: within("panel_width", share * distance))
    aside = st.just(0.0) | st.floats(-1.0, 1.0) | signed_decades(1e-6, 1.0)
    scene = Scene().replace(
        rows=draw(st.integers(1, 24)),
        columns=draw(st.integers(1, 32)),
        equivalent_focal_length=draw(decades(1e-3, 2.0)),
        distance=distance,
        panel_width=draw(size),
        panel_height=draw(size),
        offset_x=distance * draw(aside),
        offset_y=distance * draw(aside),
        yaw=draw(ANGLES),
        pitch=draw(ANGLES),
        roll=draw(st.floats(-math.pi, math.pi) | st.just(0.0)),
        pattern="1",
        illuminance=0.0,
        enhancement="none",
        iso=4e6,
    )
    return draw(
        st.just(scene) | decades(1e-10, 1.0).map(lambda remainder: grazed(scene, remainder))
    )


def grazed(scene: Scene, remainder: float) -> Scene:
    """Move a panel so near that hardly a corner of it is before the camera, on its axis."""
    half = np.array([scene.transmitter.panel_width, scene.transmitter.panel_height]) / 2
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners = signs * [*half, 0.0] @ rotation_of(scene.pose).T
    nearest = corners[corners[:, 2].argmin()]
    distance = within("distance", -nearest[2] * (1.0 + remainder))
    return scene.replace(distance=distance, offset_x=-nearest[0], offset_y=-nearest[1])


@st.composite
def lenses(draw: st.DrawFn) -> dict[str, float]:
    """Coefficients of all sizes, up to the largest allowed."""
    small = st.just(0.0) | signed_decades(1e-9, 1.0)
    k1, k2 = (10.0 * draw(small) for _ in range(2))
    p1, p2 = (draw(small) for _ in range(2))
    return {"radial_k1": k1, "radial_k2": k2, "tangential_p1": p1, "tangential_p2": p2}


SMALL: dict[str, float | str] = {
    "rows": 30,
    "columns": 40,
    "pattern": "1",
    "illuminance": 0.0,
    "enhancement": "none",
}

"""The bands of a picture stand for all of its rows."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.coverage import Coverage
from occ_model.camera.optics import Optics
from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import OpticsEffect
from occ_model.effects.registry import effects_named
from occ_model.study.signals.bands import bands_of, without_light


@pytest.mark.parametrize("curve", [-0.1, 0.03, 0.2])
def test_bands_show_the_panel_in_as_many_rows_as_pixels_do(curve: float) -> None:
    # A rim that is hollow in the middle is crossed twice from above and from below.
    scene = occ.load_preset("phone-136us-real").replace(
        rows=600, columns=900, readout_time=30e-6, radial_k1=curve, panel_width=0.6, distance=0.7
    )
    included = frozenset({"distortion", "defocus"})
    optics = Optics(panel_corners(scene))
    for effect in effects_named(included, OpticsEffect):
        optics = effect.apply(scene, optics)
    bands = bands_of(without_light(scene), included)
    assert bands.span is not None
    assert bands.weights is not None
    covered = Coverage(optics.outline, 600, 900, optics.blur).rows(range(600))
    in_pixels = (covered[bands.span.first_row : bands.span.last_row] >= 0.5).mean(axis=0)
    in_bands = (bands.panel * bands.weights).sum(axis=0)
    assert in_bands == pytest.approx(in_pixels[bands.columns], abs=1.0 / len(bands.panel))
    assert np.abs(in_bands - in_pixels[bands.columns]).mean() < 2e-3

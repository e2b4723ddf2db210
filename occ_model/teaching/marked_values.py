"""Returns the values of a parameter at which the picture changes in kind, to mark on its slider."""

from occ_model.results.teaching import MarkedValue
from occ_model.scene.scene import Scene, check_scene
from occ_model.study.bands.least_depth import DepthOver
from occ_model.study.theory import band_model_frequency, null_frequency


def marked_values(scene: Scene, parameter: str) -> tuple[MarkedValue, ...]:
    """Return the values to mark on the slider of a parameter, all else as in a scene.

    Returns
    -------
    tuple of MarkedValue
        Of the switching frequency and the exposure time: where both are equal, t = t_LED, and the
        first null of an alternating pattern, t = 2 t_LED, or of a raw pattern the shortest exposure
        without bars; of others none.
    """
    check_scene(scene)
    camera = scene.camera
    ends = {
        "switching_frequency": (band_model_frequency(scene), null_frequency(scene)),
        "exposure_time": tuple(k * scene.transmitter.switching_period for k in (1.0, 2.0)),
    }.get(parameter)
    if ends is None or camera.exposure_time <= 0.0:
        return ()
    equal, null = ends
    ends_there = "Exposure and switching period are equal: the band model ends."
    first = MarkedValue(equal, "t = t_LED", ends_there)
    if scene.transmitter.pattern and parameter == "exposure_time":
        period = DepthOver.of(scene).period * scene.transmitter.switching_period
        why = "A whole period of the pattern: no bars, here and at its whole multiples."
        return first, MarkedValue(period, "no bars", why)
    return (
        first,
        MarkedValue(null, "null", "The exposure is two chips long: the first null of 0101."),
    )

"""Values of a parameter at which the picture changes qualitatively, to mark on its slider."""

from occ_model.camera.photometry import luminance_levels
from occ_model.errors import OccError
from occ_model.results.teaching import MarkedValue
from occ_model.scene.scene import Scene
from occ_model.study.theory import band_model_frequency, null_frequency
from occ_model.transmitter.packet import sent_chips
from occ_model.transmitter.registry import FRAMINGS, LINE_CODES


def marked_values(scene: Scene, parameter: str) -> tuple[MarkedValue, ...]:
    """Return the values to mark on the slider of the frequency or of the exposure time.

    These are where t = t_LED, where t = 2 t_LED (for codes, the first null of alternating chips),
    and where the exposure is a whole period of the chips sent, so that the panel causes no bars.
    """
    exposure, transmitter = scene.camera.exposure_time, scene.transmitter
    if exposure <= 0.0 or parameter not in ("switching_frequency", "exposure_time"):
        return ()
    is_raw = bool(transmitter.pattern)
    period = _sent_period(scene)
    ends = {
        "switching_frequency": (
            band_model_frequency(scene), null_frequency(scene), period / exposure
        ),
        "exposure_time": tuple(k * transmitter.switching_period for k in (1.0, 2.0, period)),
    }  # fmt: skip
    equal, null, barless = ends[parameter]
    ends_there = "Exposure and switching period are equal: the band model ends."
    what = "pattern" if is_raw else "packet"
    why = f"The exposure is a whole {what}: no bars of the panel, here and at its whole multiples."
    marks = [MarkedValue(equal, "t = t_LED", ends_there)]
    if not is_raw:
        nulls = "The exposure is two chips long: the first null of 0101."
        marks.append(MarkedValue(null, "null", nulls))
    if period:
        flickers = scene.surroundings.flicker_depth * luminance_levels(scene)[0] > 0.0
        marks.append(MarkedValue(barless, f"whole {what}" if flickers else "no bars", why))
    return tuple(marks)


def _sent_period(scene: Scene) -> float:
    """Return the chips after which the light repeats; 0 for a steady light or an unknown packet."""
    if not scene.transmitter.luminance:
        return 0.0
    if scene.transmitter.pattern:  # a pattern can repeat inside; a packet has only one header
        # Imported only here, as packets do not need it.
        from occ_model.study.bands.least_depth import DepthOver

        over = DepthOver.of(scene)
        return float(over.period) if over.most else 0.0
    sent = scene.transmitter
    if not (LINE_CODES.is_built_in(sent.line_code) and FRAMINGS.is_built_in(sent.framing)):
        return 0.0  # marks are drawn while a slider moves, and a plug-in may be slow
    try:
        return float(len(sent_chips(sent)))
    except OccError:  # the picture's own failure says why
        return 0.0

"""Advice for a photo whose lamp has the frequency of light from the mains."""

from occ_model.scene.light_words import MAINS_HARMONIC, blinking_lamp
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ

_MAINS = (50.0, 60.0)  # in Hz
_SAME = 0.01  # relative difference from twice that


def mains_advice(scene: Scene) -> tuple[str, ...]:
    """Return a sentence if a scene's lamp has the frequency of mains light, else none."""
    lamp = blinking_lamp(scene.transmitter)
    near = [
        mains
        for mains in _MAINS
        if lamp is not None and abs(lamp.frequency / (MAINS_HARMONIC * mains) - 1.0) < _SAME
    ]
    if not near or lamp is None:
        return ()
    light, mains = HERTZ.format(lamp.frequency, 4), HERTZ.format(near[0]).replace(" ", "")
    return (
        f"Light of {light} is usually that of lamps on the mains, which swings and does not switch:"
        f" to measure a camera by it, take two pictures, and use occ-model camera --mains {mains}, "
        "measure_camera, or Photo > Measure my camera.",
    )

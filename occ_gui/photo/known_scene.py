"""What a match starts from: the scene with what the user knows, and what is sent."""

from occ_gui.values.match_choice import MatchChoice
from occ_model.scene.scene import Scene
from occ_model.scene.square_wave import blinking


def known_scene(scene: Scene, choice: MatchChoice) -> tuple[Scene, str]:
    """Return the scene with what the user knows, and where the sent pattern is taken from."""
    if choice.sent != "square":
        return scene, choice.sent
    # A lamp that is dimmed by the width of its pulses blinks too: "scene" would refuse it.
    return blinking(scene, choice.square_frequency), "auto"

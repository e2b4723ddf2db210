"""Result of the search for the scheme with the highest net bit rate."""

from dataclasses import dataclass

from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class MostBits:
    """The scheme, frequency and number of bits with a decoder's highest net bit rate.

    Parameters
    ----------
    scene
        The best scene, None where every trial failed.
    pictures
        Number of pictures tried, with a payload and a start each; all bits were right.
    bits_a_second
        Net bits a second of a video with one payload a picture.
    tried
        Number of faster combinations that were tried and not read.
    failure
        None, or a sentence on why there is no scene.
    """

    decoder: str
    scene: Scene | None
    pictures: int
    bits_a_second: float
    frames_a_second: float
    tried: int
    failure: str | None = None

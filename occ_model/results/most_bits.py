"""Result of the search for the scheme that carries most."""

from dataclasses import dataclass

from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class MostBits:
    """The scheme, frequency and number of bits that a decoder reads most with.

    Parameters
    ----------
    decoder
        The decoder's name.
    scene
        The scene that carries most, None where every trial failed.
    pictures
        Pictures that it was tried with, each with a payload and a start of its own; all bits of all
        of them were right.
    bits_a_second
        Net bits a second of a video, one payload a picture.
    frames_a_second
        Pictures a second.
    tried
        Combinations that carry more, and were tried and not read.
    failure
        None, or a sentence that says why there is no scene.
    """

    decoder: str
    scene: Scene | None
    pictures: int
    bits_a_second: float
    frames_a_second: float
    tried: int
    failure: str | None = None

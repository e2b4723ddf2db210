"""What a decoder is."""

from collections.abc import Callable
from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.results import DecodeResult
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Decoder:
    """One way to read a code from a signal.

    Parameters
    ----------
    name
        What it is called by.
    title
        What it is, in a few words.
    read
        Takes the signal, the mean grey level of each column, shape (columns,), and the scene, of
        which it may use what a receiver knows; gives the result, to which the caller adds the
        region.
    """

    name: str
    title: str
    read: Callable[[FloatArray, Scene], DecodeResult]

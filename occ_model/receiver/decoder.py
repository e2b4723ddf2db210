"""The interface of a decoder."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Decoder:
    """A method to read a code from a signal.

    Parameters
    ----------
    name
        The identifier, as on the command line.
    read
        Reads a signal, the mean grey level of each column, shape (columns,), with the parameters of
        a scene that a receiver knows. The caller adds the region to the result.
    is_quick
        Whether it reads in a few milliseconds and imports nothing slow, so that every picture of a
        live view can be read with it.
    searched_chips
        The longest exposure, in chips, to which its limits are searched: where it takes so long
        beyond that nobody would wait.
    """

    name: str
    title: str
    read: Callable[[FloatArray, Scene], DecodeResult]
    is_quick: bool = True
    searched_chips: float = math.inf

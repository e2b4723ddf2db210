"""What the explanations are made of: equations, an exposure, and the steps of an exploration."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Term:
    """A part of an equation.

    Parameters
    ----------
    text
        As HTML with ``sub`` and ``sup`` only.
    parameters
        The parameters that it depends on, by name.
    """

    text: str
    parameters: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Equation:
    """An equation, in symbols and in numbers.

    Parameters
    ----------
    source
        Its number in the paper, or where else it is from.
    meaning
        What it gives, in a few words, as HTML like a term's.
    symbols, numbers
        Its right side in symbols and with the scene's numbers.
    result
        What comes out, with its unit, or why nothing does.
    """

    source: str
    meaning: str
    symbols: tuple[Term, ...]
    numbers: tuple[Term, ...]
    result: str

    @property
    def parameters(self) -> frozenset[str]:
        """All parameters that it depends on."""
        return frozenset(name for term in self.numbers for name in term.parameters)


@dataclass(frozen=True, eq=False, slots=True)
class ExposureWindow:
    """One column's exposure on the waveform of the LED.

    Times are in seconds from the start of the first chip that is drawn.

    Parameters
    ----------
    column
        Its number.
    start, end
        When the exposure begins and ends.
    edges : ndarray of float64, shape (chips + 1,)
        When the chips about it begin, and the last one ends.
    lit : ndarray of uint8, shape (chips,)
        Whether the LED is on in each.
    on_time
        How long it is on within the exposure.
    shortened
        Whether the exposure holds more chips than are drawn; these are its first ones.
    """

    column: int
    start: float
    end: float
    edges: FloatArray
    lit: ByteArray
    on_time: float
    shortened: bool

    @property
    def exposure_time(self) -> float:
        """How long the column gathers light, in seconds."""
        return self.end - self.start

    @property
    def lit_parts(self) -> FloatArray:
        """When the LED is on within the exposure: begins and ends, shape (parts, 2).

        Chips that follow each other are parts of their own. Together they are the time on, unless
        the drawing is shortened.
        """
        begins = np.maximum(self.edges[:-1], self.start)
        ends = np.minimum(self.edges[1:], self.end)
        seen = (self.lit == 1) & (ends > begins)
        return np.stack([begins[seen], ends[seen]], axis=1)


@dataclass(frozen=True, slots=True)
class Step:
    """One step of an exploration.

    Parameters
    ----------
    text
        What there is to see.
    question
        What to find out.
    answer
        What one finds, for whoever wants to compare.
    scene
        What the window shows.
    pane
        The pane that it is best seen in, empty for whichever is at the front.
    photo
        The sample photo to open, by its name, empty for none.
    """

    text: str
    question: str
    answer: str
    scene: Scene
    pane: str = ""
    photo: str = ""


@dataclass(frozen=True, slots=True)
class Exploration:
    """A guided exploration.

    Parameters
    ----------
    name
        The file's name.
    title
        What it is about.
    steps
        One after the other.
    """

    name: str
    title: str
    steps: tuple[Step, ...]

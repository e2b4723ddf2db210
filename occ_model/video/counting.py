"""Count which chips and packets frames show whole, in exact arithmetic.

A frame that starts at s shows the chips that lie completely between the start of its first column's
exposure and the end of its last one's: chip n if n / f >= s + a t_r and (n + 1) / f <= s + b t_r +
t, with a and b the first and the last column of the panel. Nothing is simulated: this is what a
receiver without errors could read.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor

from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class ShutterTiming:
    """The exact timing of a scene that counting needs."""

    frequency: Fraction  # Chips per second
    # In seconds
    exposure_time: Fraction
    readout_time: Fraction
    # The first and the last column that show the panel
    first: int
    last: int

    @classmethod
    def of(cls, scene: Scene, columns: tuple[int, int]) -> "ShutterTiming":
        """Return a scene's timing; ``columns``: the panel's first, and the one after its last."""
        first, end = columns
        return cls(
            Fraction(scene.transmitter.switching_frequency),
            Fraction(scene.camera.exposure_time),
            Fraction(scene.camera.readout_time),
            first,
            end - 1,
        )

    @property
    def view(self) -> Fraction:
        """Time from the start of the first column's exposure to the end of the last one's."""
        return (self.last - self.first) * self.readout_time + self.exposure_time

    def whole_chips(self, start: Fraction) -> tuple[int, int]:
        """Return the first whole chip and the one after the last; ``start``: of column 0, in s."""
        begin = (start + self.first * self.readout_time) * self.frequency
        return ceil(begin), floor(begin + self.view * self.frequency)

    def whole_packets(self, start: Fraction, length: int) -> int:
        """Return how many packets of ``length`` chips a frame shows whole."""
        first, end = self.whole_chips(start)
        return max(end // length - -(-first // length), 0)


def mean_packets_received(timing: ShutterTiming, frame_period: Fraction, length: int) -> Fraction:
    """Return the fraction of packets that frames show whole, averaged over the start time.

    A view of V >= L chips contains on average (V - L) / L whole packets of L chips.
    """
    view = timing.view * timing.frequency
    return max(view - length, Fraction(0)) / (timing.frequency * frame_period)

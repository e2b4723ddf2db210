"""Result of a bit error rate: the bits that were wrong, and what that leaves a second."""

from dataclasses import dataclass

from occ_model.scene.recording import FRAME_RATE

FRAMES_A_SECOND = FRAME_RATE.default
"""Pictures that a camera takes a second where nothing else is said."""


_ABOVE_HALF = "Above 0.5: a payload that is not read counts with all its bits wrong."


@dataclass(frozen=True, slots=True)
class BitErrors:
    """Bits that a decoder read wrongly or not at all, of random payloads in a picture each.

    Parameters
    ----------
    decoder
        Its name.
    bits
        Bits sent.
    errors
        Bits of them that were wrong, those of a payload that was not read included.
    low, high
        The 95 % interval of the rate. The bits of one payload fail together; so it rests on how
        much the pictures differ, and on the pictures alone where all or none of the bits are wrong.
    pictures
        Pictures, one payload each.
    pictures_right
        Pictures of which all bits were right, and accepted by the decoder.
    right_low, right_high
        The 95 % interval of the fraction of pictures of which all bits are right.
    picture_time
        Time in seconds in which the columns of the panel are read out.
    readout_time
        Time in seconds in which all columns of the picture are read out.
    """

    decoder: str
    bits: int
    errors: int
    low: float
    high: float
    pictures: int
    pictures_right: int
    right_low: float
    right_high: float
    picture_time: float
    readout_time: float

    @property
    def rate(self) -> float:
        """The fraction of the bits that are wrong, from 0 to 1."""
        return self.errors / self.bits

    @property
    def why_above_half(self) -> str:
        """Why more bits are wrong than a guess gets wrong; empty where they are not."""
        return _ABOVE_HALF if self.rate > 0.5 else ""

    @property
    def bits_a_picture(self) -> float:
        """Bits of a payload, times the fraction of the payloads that are right."""
        return self.bits / self.pictures * (self.pictures_right / self.pictures)

    @property
    def bits_a_second_of_picture(self) -> float:
        """Net bits a second while the panel is read out; 0 where no picture shows it."""
        return self.bits_a_picture / self.picture_time if self.picture_time else 0.0

    def bits_a_second(self, frames_a_second: float = FRAMES_A_SECOND) -> float:
        """Return the net bits a second of a video, whose every picture shows another payload.

        What is sent in the gap between two pictures is lost: see :meth:`gap`.
        """
        return self.bits_a_picture * frames_a_second

    def bits_a_second_interval(
        self, frames_a_second: float = FRAMES_A_SECOND
    ) -> tuple[float, float]:
        """Return the 95 % interval of :meth:`bits_a_second`."""
        most = self.bits / self.pictures * frames_a_second
        return most * self.right_low, most * self.right_high

    def gap(self, frames_a_second: float = FRAMES_A_SECOND) -> float:
        """Return the time between the last column of a picture and the first of the next, in s.

        It is below 0 where the camera cannot take so many pictures.
        """
        return 1.0 / frames_a_second - self.readout_time


def bits_a_second(share: float, bits: int, frames_a_second: float, readout_time: float) -> float:
    """Return the net bits a second of a video whose every picture shows another payload.

    Parameters
    ----------
    share
        Of the pictures of which every bit is right.
    readout_time
        Time in seconds in which a picture is read out: no picture begins before the end of the one
        before, however many are asked for.
    """
    return share * bits * min(frames_a_second, 1.0 / readout_time)

"""What to beware of with a blinking light: flicker that is seen, and bright light in the eyes."""

from occ_model.boards.transmission import Transmission
from occ_model.scene.units import HERTZ, SECOND
from occ_model.transmitter.line_codes.line_code import VISIBLE_LIMIT

EYES = (
    "Do not look into a bright LED or panel from near, nor let others do so; turn it off when "
    "nobody photographs it."
)

SEIZURES = (
    "Flicker of 3 to 70 Hz can cause seizures in people with photosensitive epilepsy "
    "(IEEE 1789-2015)."
)


def flicker_sentence(sent: Transmission) -> str:
    """State the lowest frequency in the light, of the repeated packet, and if it is visible."""
    lowest, run = sent.lowest_frequency, sent.longest_run
    if lowest is None or run is None:
        return "The light does not change: all chips are equal."
    limit = HERTZ.format(VISIBLE_LIMIT)
    said = (
        f"The lowest frequency in the light is {HERTZ.format(float(lowest), 4)}, with which the "
        f"packet repeats; its longest time without an edge is {SECOND.format(float(run), 4)}."
    )
    if sent.is_visible:
        return (
            f"{said} Below {limit} (IEEE 802.15.7) it may be seen as flicker: raise the switching "
            f"frequency, or send fewer bits. {SEIZURES}"
        )
    return f"{said} It is above {limit}, below which flicker may be seen (IEEE 802.15.7)."

"""The list of decoders by name, and the default."""

from occ_model.errors import ParameterError, shown
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.matched.decoder import DECODER as MATCHED
from occ_model.receiver.sequence.decoder import DECODER as SEQUENCE
from occ_model.receiver.threshold.decoder import DECODER as THRESHOLD

PAPER_DECODER = THRESHOLD.name
"""The name of the paper's decoder, which is the default."""

DECODERS: dict[str, Decoder] = {decoder.name: decoder for decoder in (THRESHOLD, MATCHED, SEQUENCE)}
"""The decoders by name."""


def decoder_named(name: str) -> Decoder:
    """Find a decoder.

    Raises
    ------
    ParameterError
        No decoder has that name; the message lists the known names.
    """
    if not isinstance(name, str) or name not in DECODERS:
        raise ParameterError(f"There is no decoder {shown(name)}; known: {', '.join(DECODERS)}.")
    return DECODERS[name]

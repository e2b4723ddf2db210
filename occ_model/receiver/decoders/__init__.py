"""The decoders: every module of this folder holds one, as ``DECODER``."""

import pkgutil
from importlib import import_module

from occ_model.errors import ParameterError, shown
from occ_model.receiver.decoder import Decoder


def _found() -> dict[str, Decoder]:
    modules = (
        import_module(f"{__name__}.{entry.name}") for entry in pkgutil.iter_modules(__path__)
    )
    decoders: list[Decoder] = [module.DECODER for module in modules]
    # The paper's first, the others by name.
    decoders.sort(key=lambda decoder: (decoder.name != PAPERS, decoder.name))
    return {decoder.name: decoder for decoder in decoders}


PAPERS = "threshold"
"""The name of the paper's decoder, which is the default."""

DECODERS: dict[str, Decoder] = _found()
"""The decoders by name."""


def decoder_named(name: str) -> Decoder:
    """Find a decoder.

    Raises
    ------
    ParameterError
        There is none of that name; the names there are stand in the message.
    """
    if not isinstance(name, str) or name not in DECODERS:
        raise ParameterError(f"There is no decoder {shown(name)}; known: {', '.join(DECODERS)}.")
    return DECODERS[name]

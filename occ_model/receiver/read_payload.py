"""From chips to the payload: the last step of every decoder that finds chips."""

from dataclasses import replace

from occ_model.results.decoding import DecodeResult
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.packet import code_of
from occ_model.transmitter.scheme import scheme_of


def read_payload(result: DecodeResult, scene: Scene) -> DecodeResult:
    """Find frames among the chips of a result, and read the payload by the scene's scheme.

    Returns the result with headers, bits, code and payload, or with the failure that says why not.
    """
    return with_bits(result, scheme_of(scene.transmitter).decode(result.chips), scene)


def with_bits(result: DecodeResult, framed: Framed, scene: Scene) -> DecodeResult:
    payload = scene.transmitter.payload
    bits = framed.bits.tolist()
    return replace(
        result,
        headers=framed.headers,
        bits=framed.bits,
        code=code_of(bits) if framed.failure is None else None,
        payload=payload_of_bits(bits, form_of(payload)) if payload else "",
        failure=framed.failure,
    )

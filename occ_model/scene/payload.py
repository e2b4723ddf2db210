"""Payloads as texts: ``text:HELLO``, ``hex:48656c6c6f`` and ``bits:0100100001``.

The word before the colon is the form in which a payload is written, and in which a received one is
shown. Without one of these words a payload is a text: ``HELLO`` is ``text:HELLO``.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

from occ_model.errors import quote

MAX_PAYLOAD_BITS = 4096

PAYLOADS = (  # the forms of a payload, for sentences
    "HELLO or text:HELLO (UTF-8), hex:48656c6c6f or bits:0100100001, "
    f"of 1 to {MAX_PAYLOAD_BITS} bits"
)

_FORMS = ("text", "hex", "bits")
_SHORT_FORM = re.compile(r"\s*(?:0x([0-9a-f ]+)|0b([01 ]+))", re.IGNORECASE)
"""Bytes or bits as in program code."""

_DIGITS_ALONE = re.compile("[0-9 ]*")

_REPLACEMENT_LETTER = "?"  # stands for bytes that are not text


def canonical_payload(value: object) -> str:
    """Return a payload in its canonical form; a ValueError ends a sentence: "has 0 bits"."""
    if not isinstance(value, str):
        raise ValueError(f"is {quote(value)}")  # noqa: TRY004 - one kind for all wrong values
    if len(value) > 4 * MAX_PAYLOAD_BITS:
        raise ValueError(f"is a text of {len(value):,} characters")
    if not value.strip():
        return ""
    form, content = _split_form(value)
    if form != "text":
        content = "".join(content.split()).lower()
    if not _is_content(form, content):
        raise ValueError(f"is {quote(value)}")
    text = f"{form}:{content}"
    count = len(bits_of_payload(text))
    if not 1 <= count <= MAX_PAYLOAD_BITS:
        raise ValueError(f"has {count:,} bits")
    return text


def _split_form(typed: str) -> tuple[str, str]:
    word, colon, content = typed.partition(":")
    form = word.strip().lower()
    if colon and form in _FORMS:
        return form, content
    short = _SHORT_FORM.fullmatch(typed)
    if short:
        return ("hex", short[1]) if short[1] is not None else ("bits", short[2])
    return "text", typed


def typed_form(payload: str) -> str:
    """Return a payload as one would type it: a text without its form, unless that is ambiguous."""
    form, _, content = payload.partition(":")
    if form != "text" or not content.strip() or _DIGITS_ALONE.fullmatch(content):
        return payload
    return content if _split_form(content) == ("text", content) else payload


def _is_content(form: str, content: str) -> bool:
    match form:
        case "text":
            # Half of a surrogate pair is no character.
            return not any("\ud800" <= letter <= "\udfff" for letter in content)
        case "hex":
            return re.fullmatch("(?:[0-9a-f]{2})*", content) is not None
        case "bits":
            return not set(content) - {"0", "1"}
    return False


@lru_cache(maxsize=64)
def bits_of_payload(payload: str) -> tuple[int, ...]:
    """Return the bits of a canonical payload, the most significant of each byte first."""
    form, _, content = payload.partition(":")
    if form == "bits":
        return tuple(map(int, content))
    octets = bytes.fromhex(content) if form == "hex" else content.encode("utf-8")
    return tuple(octet >> place & 1 for octet in octets for place in range(7, -1, -1))


def payload_of_bits(bits: Sequence[int], form: str) -> str:
    """Write bits as ``text``, ``hex`` or ``bits``, without the form's name.

    Text and hex end with the last whole byte. In a text, question marks stand for bytes that are no
    text, and for characters that cannot be printed.
    """
    if form == "bits":
        return "".join(str(int(bit)) for bit in bits)
    whole = len(bits) // 8 * 8
    octets = bytes(
        sum(int(bit) << 7 - place for place, bit in enumerate(bits[start : start + 8]))
        for start in range(0, whole, 8)
    )
    if form == "hex":
        return octets.hex()
    text = octets.decode("utf-8", errors="replace")
    return "".join(
        letter if letter.isprintable() and letter != "\ufffd" else _REPLACEMENT_LETTER
        for letter in text
    )


def form_of(payload: str) -> str:
    """Return the form of a payload: ``text``, ``hex`` or ``bits``."""
    return payload.partition(":")[0]


@dataclass(frozen=True, slots=True)
class PayloadPiece:
    """A letter of a text, or a byte in hex, as sent and as received."""

    # As written; ``received`` is empty if not all of its bits were received
    sent: str
    received: str
    is_right: bool
    # Index of its first bit among those sent, and of the bit after its last
    first: int
    last: int


def compare_payload(payload: str, received: Sequence[int]) -> tuple[PayloadPiece, ...]:
    """Compare a text or bytes with received bits, piece by piece; empty for a payload of bits."""
    if form_of(payload) not in ("text", "hex"):
        return ()
    bits, pieces, start = bits_of_payload(payload), [], 0
    for letter in _letters(payload):
        end = start + 8 * (len(letter.encode()) if form_of(payload) == "text" else 1)
        own = tuple(received[start:end])
        text = payload_of_bits(own, form_of(payload)) if len(own) == end - start else ""
        sent = payload_of_bits(bits[start:end], form_of(payload))
        pieces.append(PayloadPiece(sent, text, own == bits[start:end], start, end))
        start = end
    return tuple(pieces)


def _letters(payload: str) -> Iterator[str]:
    form, _, content = payload.partition(":")
    step = 2 if form == "hex" else 1
    return (content[place : place + step] for place in range(0, len(content), step))

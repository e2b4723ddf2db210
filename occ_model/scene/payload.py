"""Payloads as texts: ``text:HELLO``, ``hex:48656c6c6f`` and ``bits:0100100001``.

The word before the colon is the form in which the payload is written, and a received one is shown.
Without one of these words it is a text: ``HELLO`` is ``text:HELLO``.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

from occ_model.errors import shown

MAX_PAYLOAD_BITS = 4096

PAYLOADS = (  # the forms of a payload, in words
    "HELLO or text:HELLO (UTF-8), hex:48656c6c6f or bits:0100100001, "
    f"of 1 to {MAX_PAYLOAD_BITS} bits"
)

_FORMS = ("text", "hex", "bits")
_SHORT_FORM = re.compile(r"\s*(?:0x([0-9a-f ]+)|0b([01 ]+))", re.IGNORECASE)
"""Bytes or bits as programs write them."""

_DIGITS_ALONE = re.compile("[0-9 ]*")

_REPLACEMENT_LETTER = "?"  # in place of bytes that are not text


def canonical(value: object) -> str:
    """Return a payload in its shortest form; a ValueError holds a part of a sentence."""
    if not isinstance(value, str):
        raise ValueError(f"is {shown(value)}")  # noqa: TRY004 - a wrong value as any other
    if len(value) > 4 * MAX_PAYLOAD_BITS:
        raise ValueError(f"is a text of {len(value):,} characters")
    if not value.strip():
        return ""
    form, content = _form_and_content(value)
    if form != "text":
        content = "".join(content.split()).lower()
    if not _is_content(form, content):
        raise ValueError(f"is {shown(value)}")
    text = f"{form}:{content}"
    count = len(bits_of_payload(text))
    if not 1 <= count <= MAX_PAYLOAD_BITS:
        raise ValueError(f"has {count:,} bits")
    return text


def _form_and_content(typed: str) -> tuple[str, str]:
    word, colon, content = typed.partition(":")
    form = word.strip().lower()
    if colon and form in _FORMS:
        return form, content
    short = _SHORT_FORM.fullmatch(typed)
    if short:
        return ("hex", short[1]) if short[1] is not None else ("bits", short[2])
    return "text", typed


def typed_form(payload: str) -> str:
    """Return a payload as it is typed: a text as it is, if no other form has it."""
    form, _, content = payload.partition(":")
    if form != "text" or not content.strip() or _DIGITS_ALONE.fullmatch(content):
        return payload
    return content if _form_and_content(content) == ("text", content) else payload


def _is_content(form: str, content: str) -> bool:
    match form:
        case "text":
            # Half of a surrogate pair is not a character.
            return not any("\ud800" <= letter <= "\udfff" for letter in content)
        case "hex":
            return re.fullmatch("(?:[0-9a-f]{2})*", content) is not None
        case "bits":
            return not set(content) - {"0", "1"}
    return False


@lru_cache(maxsize=64)
def bits_of_payload(payload: str) -> tuple[int, ...]:
    """Return the bits of a payload in its canonical form, each byte's most significant first."""
    form, _, content = payload.partition(":")
    if form == "bits":
        return tuple(map(int, content))
    octets = bytes.fromhex(content) if form == "hex" else content.encode("utf-8")
    return tuple(octet >> place & 1 for octet in octets for place in range(7, -1, -1))


def payload_of_bits(bits: Sequence[int], form: str) -> str:
    """Write bits as ``text``, ``hex`` or ``bits``, without the form's name, from whole bytes.

    Bytes that are not text are written as question marks, and so are hidden characters.
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
class Piece:
    """A letter of a text or a byte in hex, as sent and as received."""

    # How it is written; ``received`` is empty where its bits were not received
    sent: str
    received: str
    is_right: bool
    # Its first bit among those sent, and the one after its last
    first: int
    last: int


def compared(payload: str, received: Sequence[int]) -> tuple[Piece, ...]:
    """Compare a payload with received bits, letter by letter or byte by byte; empty for bits."""
    if form_of(payload) not in ("text", "hex"):
        return ()
    bits, pieces, start = bits_of_payload(payload), [], 0
    for letter in _letters(payload):
        end = start + 8 * (len(letter.encode()) if form_of(payload) == "text" else 1)
        seen = tuple(received[start:end])
        written = payload_of_bits(seen, form_of(payload)) if len(seen) == end - start else ""
        shown_letter = payload_of_bits(bits[start:end], form_of(payload))
        pieces.append(Piece(shown_letter, written, seen == bits[start:end], start, end))
        start = end
    return tuple(pieces)


def _letters(payload: str) -> Iterator[str]:
    form, _, content = payload.partition(":")
    step = 2 if form == "hex" else 1
    return (content[place : place + step] for place in range(0, len(content), step))

"""Find whether a file says that its samples are in proportion to the light."""

import struct
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage

_LINEAR_TRANSFER = 8  # of ITU-T H.273, table 3
_CURVES = (b"rTRC", b"gTRC", b"bTRC", b"kTRC")  # tags of an ICC profile: of red, green, blue, grey
_FIRST_TAG = 128  # bytes of an ICC profile's header
_MOST_TAGS = 100


def is_linear_picture(picture: "PillowImage") -> bool:
    """Return whether a picture's nclx or ICC profile, or else its PNG gamma, is linear."""
    info = picture.info
    nclx, profile = info.get("nclx_profile"), info.get("icc_profile")
    if isinstance(nclx, dict):
        return nclx.get("transfer_characteristics") == _LINEAR_TRANSFER
    if isinstance(profile, bytes) and profile:
        return _is_linear_profile(profile)
    return info.get("gamma") == 1.0 and "srgb" not in info


def _is_linear_profile(profile: bytes) -> bool:
    """Return whether all curves of an ICC profile (ICC.1:2022, 10.6 and 10.18) are straight."""
    try:
        (count,) = struct.unpack_from(">L", profile, _FIRST_TAG)
        tags = [
            struct.unpack_from(">4sLL", profile, _FIRST_TAG + 4 + 12 * place)
            for place in range(min(count, _MOST_TAGS))
        ]
        curves = [profile[start : start + size] for tag, start, size in tags if tag in _CURVES]
        return bool(curves) and all(map(_is_straight, curves))
    except struct.error:
        return False


def _is_straight(curve: bytes) -> bool:
    if curve.startswith(b"para"):  # its function of type 0 is a power; linear if the exponent is 1
        return struct.unpack_from(">HxxL", curve, 8) == (0, 1 << 16)
    (count,) = struct.unpack_from(">L", curve, 8)
    if not curve.startswith(b"curv") or count > 1:
        return False
    # A curve of no numbers is the identity; a single number is the exponent of a power.
    return count == 0 or struct.unpack_from(">H", curve, 12) == (1 << 8,)

"""Usual shutter speeds of cameras: as marked, and as kept."""

from fractions import Fraction

from occ_model.results.bands import ShutterSpeed

_THIRDS = (
    "1", "0.8", "0.6", "0.5", "0.4", "0.3", "1/4", "1/5", "1/6", "1/8", "1/10", "1/13", "1/15",
    "1/20", "1/25", "1/30", "1/40", "1/50", "1/60", "1/80", "1/100", "1/125", "1/160", "1/200",
    "1/250", "1/320", "1/400", "1/500", "1/640", "1/800", "1/1000", "1/1250", "1/1600", "1/2000",
    "1/2500", "1/3200", "1/4000", "1/5000", "1/6400", "1/8000",
)  # fmt: skip
"""Marked times in seconds, in thirds of a stop. The k-th is really 2^(-k/3) s, so that 1/60 s is
1/64 s and 1/125 s is 1/128 s."""

_OTHERS = ("1/48", "1/96", "1/120", "1/240")  # of film cameras and phones, kept as marked


def shutter_speeds() -> tuple[ShutterSpeed, ...]:
    """Return the usual shutter speeds from 1 s to 1/8000 s, the longest first."""
    thirds = [
        ShutterSpeed(f"{name} s", float(Fraction(name)), 2.0 ** (-step / 3.0))
        for step, name in enumerate(_THIRDS)
    ]
    others = [ShutterSpeed(f"{name} s", *[float(Fraction(name))] * 2) for name in _OTHERS]
    return tuple(sorted(thirds + others, key=lambda speed: -speed.nominal))

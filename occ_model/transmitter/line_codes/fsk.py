"""FSK of the rolling shutter: a symbol is a frequency, and so a width of the stripes.

A symbol is twelve chips of a square wave whose half period is 1, 2, 3 or 6 chips; it carries two
bits. The frequencies are f/2, f/4, f/6 and f/12. Each symbol holds whole periods, starts dark and
ends lit. It is on-off keying of a frequency as in UFSOOK and RS-FSK (IEEE 802.15.7-2018), with
several symbols in one picture; there a picture shows one frequency.
"""

import numpy as np

from occ_model.transmitter.line_codes.line_code import LineCode
from occ_model.transmitter.line_codes.word_table import WordTable

SYMBOL_CHIPS = 12  # chips of a symbol: the fewest that hold whole periods of all four frequencies
HALF_PERIODS = (1, 2, 3, 6)  # chips of half a period, of the symbols 0 to 3

# The symbols differ in at least four chips, so one wrong chip is corrected.
_TABLE = WordTable(
    np.array(
        [np.arange(SYMBOL_CHIPS) // half % 2 for half in HALF_PERIODS],
        dtype=np.uint8,
    ),
    "symbol of one frequency",
    corrected=1,
)

LINE_CODE = LineCode(
    "fsk",
    "FSK: two bits are one of four frequencies",
    block_bits=2,
    block_chips=SYMBOL_CHIPS,
    longest_run=max(HALF_PERIODS),
    disparity=0,
    finds_wrong_chip=True,
    encode=_TABLE.encode,
    decode=_TABLE.decode,
)

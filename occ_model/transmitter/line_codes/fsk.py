"""FSK for a rolling shutter: a symbol is a frequency, which sets the width of the stripes.

A symbol carries two bits. It is twelve chips of a square wave whose half period is 1, 2, 3 or 6
chips, so that the frequencies are f/2, f/4, f/6 and f/12. Each symbol has whole periods, starts
dark and ends lit. As in UFSOOK and RS-FSK (IEEE 802.15.7-2018), light is switched at a frequency,
but a picture shows several symbols instead of one frequency.
"""

import numpy as np

from occ_model.transmitter.line_codes.line_code import LineCode, WordTable

SYMBOL_CHIPS = 12  # chips of a symbol, the fewest that have whole periods of all four frequencies
HALF_PERIODS = (1, 2, 3, 6)  # chips of half a period, for the symbols 0 to 3

# The symbols differ in at least four chips, so that one wrong chip can be corrected.
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

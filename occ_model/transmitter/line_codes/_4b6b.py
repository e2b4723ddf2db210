"""4B6B, the run-length limited code of IEEE 802.15.7 for VPPM and C-OOK.

The table is that of IEEE 802.15.7-2018, 10.5.1 (4B6B encoding). Every word has three ones, so that
all words are equally bright, and a single wrong chip always gives a word outside the table.
"""

import numpy as np

from occ_model.transmitter.line_codes.line_code import LineCode, WordTable

_WORDS = (  # for the numbers 0 to 15
    "001110 001101 010011 010110 010101 100011 100110 100101 "
    "011001 011010 011100 110001 110010 101001 101010 101100"
)

_TABLE = WordTable(np.array([[*map(int, word)] for word in _WORDS.split()], np.uint8), "4B6B word")

LINE_CODE = LineCode(
    "4b6b",
    "4B6B (IEEE 802.15.7)",
    block_bits=4,
    block_chips=6,
    longest_run=4,
    disparity=0,
    finds_wrong_chip=True,
    encode=_TABLE.encode,
    decode=_TABLE.decode,
)

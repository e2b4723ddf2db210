"""How many lamps are found in simulated photographs.

``python tests/benchmarks/lamps.py 60 3000`` takes 60 from seed 3000 on; without numbers it takes
200. They have one to eight lamps, drawn without the model; with ``hot`` after the numbers those
with hot spots, halos and slopes, at exposures of 0.05 to 8 chips.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from photo_world.hot_lamps import hot_lamp_scene
from photo_world.lamp_scenes import lamp_scene
from photo_world.lamp_scores import score_of

FIRST = 1000
"""First seed: those below were looked at while the search was made."""

if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    first = int(sys.argv[2]) if len(sys.argv) > 2 else FIRST
    draw = hot_lamp_scene if "hot" in sys.argv[3:] else lamp_scene
    print("\n".join(score_of(range(first, first + count), draw).lines()))

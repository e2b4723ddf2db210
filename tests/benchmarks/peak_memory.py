"""Prints how many bytes a complete simulation needs at its peak, in bytes of its picture."""

import resource
import sys

import occ_model as occ

scene = occ.load_preset(sys.argv[1])
occ.render(scene.replace(rows=200), tolerance=0.0)  # all that is loaded once is loaded now
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
image = occ.render(scene, tolerance=0.0).image
after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print((after - before) * 1024 / image.nbytes)

# %% [markdown]
# # What accuracy costs in time
#
# The closed form of the exposure is exact, and takes the same time for every exposure. Sampling the
# exposure in time is slower the more exact it is, and never gets there.

# %%
from itertools import takewhile

import matplotlib.pyplot as plt

import occ_model as occ

scene = occ.load_preset("phone-136us").replace(switching_frequency=10e3)
study = occ.accuracy(scene)  # gives its points one by one, those of the integration first
points = list(takewhile(lambda point: point.part == "integration", study))

# %%
figure, axis = plt.subplots(figsize=(8, 3.5))
for place, point in enumerate(points):
    time, error = point.seconds * 1e3, max(point.error, 1e-13)
    axis.loglog(time, error, "o", color="C0")
    if place % 3 == 0 or point is points[-1]:
        offset = {"textcoords": "offset points", "xytext": (5, 5), "fontsize": 8}
        axis.annotate(point.name, (time, error), **offset)
axis.set(xlabel="time in ms", ylabel="error in grey levels (RMS)")
figure.tight_layout()
plt.show()

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
for point in points:
    axis.loglog(point.seconds * 1e3, max(point.error, 1e-13), "o", color="C0")
    axis.annotate(
        point.name,
        (point.seconds * 1e3, max(point.error, 1e-13)),
        textcoords="offset points",
        xytext=(5, 3),
        fontsize=7,
    )
axis.set(xlabel="time in ms", ylabel="error in grey levels (RMS)")
figure.tight_layout()
plt.show()

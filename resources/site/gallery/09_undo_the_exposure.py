# %% [markdown]
# # Undo the exposure
#
# At 20 kHz an exposure of 136 µs covers 2.7 chips. The light of the chips is still in the profile,
# filtered. The equalizer undoes the filter as far as the noise allows, and needs no list of codes.

# %%
import matplotlib.pyplot as plt

import occ_model as occ

scene = occ.load_preset("phone-136us").replace(
    switching_frequency=20e3, enhancement="none", code=718
)
frame = occ.render(scene, seed=3)
threshold = occ.decode(frame.image, scene, decoder="threshold")
equalizer = occ.decode(frame.image, scene, decoder="equalizer")
print("threshold:", threshold.code, threshold.failure)
print("equalizer:", equalizer.code)

# %%
figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(8, 4))
above.plot(threshold.signal[:300])
above.set(ylabel="grey level", title="what the camera sees")
below.plot(equalizer.equalized[:300])
below.set(xlabel="column of the panel", ylabel="light", title="the same, with the exposure undone")
figure.tight_layout()
plt.show()

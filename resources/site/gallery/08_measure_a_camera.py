# %% [markdown]
# # Measure a camera with a photo
#
# A photo of an LED that blinks at a known frequency tells the camera's readout time and exposure.
# The match says whether it is sure, and gives each result with its standard deviation.

# %%
from pathlib import Path

import matplotlib.pyplot as plt

import occ_model as occ

folder = Path("resources/photos")
photo = occ.load_photo(folder / "led-1khz.jpg")
scene = occ.load_preset("phone-136us").replace(pattern="01", switching_frequency=2e3)
match = occ.match_photo(photo, scene)
for name in ("readout_time", "exposure_time"):
    value, deviation = getattr(match, name), match.uncertainties[name]
    print(f"{name}: {value * 1e6:.3f} µs, standard deviation {deviation * 1e6:.3f} µs")
print("verdict:", match.verdict, *match.reasons)

# %%
figure, axis = plt.subplots(figsize=(8, 3.5))
axis.plot(match.stripes.profile[:300], label="photo")
axis.plot(match.profile[:300], "--", label="fitted scene")
axis.set(xlabel="column of the lamp", ylabel="grey level")
axis.legend()
figure.tight_layout()
plt.show()

# %% [markdown]
# # A code as stripes
#
# The panel sends the code 718 over and over, one chip every 250 µs. The camera reads one column
# every 8 µs, so that a chip is 31 columns wide. A column gathers light for 68 µs: where the LED
# changes its state, a slope of 68 / 8 = 8.5 columns joins the two levels.

# %%
import matplotlib.pyplot as plt

import occ_model as occ

scene = occ.load_preset("phone-68us").replace(switching_frequency=4e3, code=718)
frame = occ.render(scene)

# %%
figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(8, 4))
middle = frame.camera_image.shape[0] // 2
shown = slice(1500, 2100)
above.imshow(
    frame.camera_image[middle - 60 : middle + 60, shown],
    cmap="gray",
    vmin=0,
    vmax=255,
    aspect="auto",
    extent=(1500, 2100, 0, 120),
)
above.set_yticks([])
below.plot(range(1500, 2100), frame.profile[shown])
below.set(xlabel="column", ylabel="grey level")
figure.tight_layout()
plt.show()

# %% [markdown]
# The receiver enhances the contrast, finds the panel, and reads the chips from the lengths of the
# bright and the dark runs.

# %%
result = occ.decode(frame.image, scene)
print("sent:", scene.transmitter.code, "read:", result.code)

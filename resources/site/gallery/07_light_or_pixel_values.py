# %% [markdown]
# # Averaging light, or pixel values
#
# The paper averages pixel values. In a sensor light adds up before the gamma encoding. Both models
# are offered; they differ most where a column is half in the light.

# %%
import matplotlib.pyplot as plt
import numpy as np

import occ_model as occ

scene = occ.load_preset("phone-136us").replace(switching_frequency=7e3)
profiles = {
    averaging: occ.column_profile(scene.replace(averaging=averaging))
    for averaging in ("pixel-value", "light")
}

# %%
figure, axis = plt.subplots(figsize=(8, 3.5))
for averaging, profile in profiles.items():
    axis.plot(profile[:250], label=averaging)
axis.set(xlabel="column", ylabel="grey level")
axis.legend()
figure.tight_layout()
plt.show()

# %%
difference = profiles["light"] - profiles["pixel-value"]
print(f"largest difference: {np.abs(difference).max():.1f} grey levels")

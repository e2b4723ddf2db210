# %% [markdown]
# # The nulls of alternating chips
#
# An exposure is a moving average. It multiplies a sine of the frequency F by |sinc(F t)|, which is
# zero wherever the exposure is a whole number of periods long. Chips that alternate, 0101..., are a
# square wave of half the switching frequency: their stripes vanish at f = 2/t, 4/t, ...

# %%
import matplotlib.pyplot as plt
import numpy as np

import occ_model as occ

exposure = 136e-6
scene = occ.load_preset("phone-136us").replace(pattern="01", exposure_time=exposure)
frequencies = np.linspace(1e3, 40e3, 157)


def swing(frequency):
    """Return half the difference between the longest and the shortest time in the light."""
    lit = occ.on_time(scene.replace(switching_frequency=frequency)) / exposure
    return np.ptp(lit) / 2


swings = np.array([swing(frequency) for frequency in frequencies])

# %% [markdown]
# A square wave has odd harmonics beside its fundamental, so its swing is a triangle-like curve
# above the |sinc| of the fundamental alone. The nulls are the same.

# %%
figure, axis = plt.subplots(figsize=(8, 3.5))
axis.plot(frequencies / 1e3, swings, label="stripes of 0101...")
fundamental = 2 / np.pi * np.abs(np.sinc(frequencies / 2 * exposure))
axis.plot(frequencies / 1e3, fundamental, "--", label="(2/π) |sinc(f t / 2)|")
for order in (1, 2):
    axis.axvline(order * 2 / exposure / 1e3, color="grey", linewidth=0.8)
axis.set(xlabel="switching frequency in kHz", ylabel="half swing, fraction of full light")
axis.legend()
figure.tight_layout()
plt.show()

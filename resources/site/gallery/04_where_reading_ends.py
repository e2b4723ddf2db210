# %% [markdown]
# # Where reading ends
#
# The paper's decoder finds a threshold between bright and dark and measures runs. Near the null of
# the alternating chips, 2/t = 14.7 kHz at 136 µs, nothing is left to threshold. The matched decoder
# knows the exposure: it compares the whole profile with the one that each code would make.

# %%
import matplotlib.pyplot as plt

import occ_model as occ

scene = occ.load_preset("phone-136us").replace(distance=1.2)
frequencies = [4e3, 8e3, 12e3, 13e3, 14e3, 15e3, 16e3, 20e3, 30e3, 40e3]
table = occ.sweep(
    scene, {"switching_frequency": frequencies}, images=5, decoder=("threshold", "matched")
)

# %% [markdown]
# Each rate has Wilson's 95 % interval. It assumes independent bits, so with five pictures it is a
# lower bound of the true one.

# %%
figure, axis = plt.subplots(figsize=(8, 3.5))
for number, decoder in enumerate(table.decoders):
    rates = 100.0 * table.right[:, number] / table.sent
    interval = (rates - table.low[:, number], table.high[:, number] - rates)
    axis.errorbar(
        [f / 1e3 for f in frequencies], rates, yerr=interval, marker="o", capsize=3, label=decoder
    )
axis.axvline(2 / 136e-6 / 1e3, color="grey", linewidth=0.8)
axis.set(xlabel="switching frequency in kHz", ylabel="bits read correctly, %")
axis.legend()
figure.tight_layout()
plt.show()

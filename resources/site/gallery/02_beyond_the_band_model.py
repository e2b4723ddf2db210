# %% [markdown]
# # Where the band model ends
#
# The band model draws each chip as a band of (t_LED - t) / t_r columns and each change of state as
# a slope of t / t_r columns. It needs a switching period longer than the exposure. Read to the
# letter it also drifts: a run of several equal chips has no slope inside, and so comes out too
# short. The exposure integral needs nothing: a column holds the mean of the light over its
# exposure, however many chips that covers.

# %%
import matplotlib.pyplot as plt

import occ_model as occ

scene = occ.load_preset("phone-136us")

# %%
frequencies = (3e3, 7e3, 10e3)
refusals = {}
figure, axes = plt.subplots(len(frequencies), 1, figsize=(8, 6))
for axis, frequency in zip(axes, frequencies, strict=True):
    each = scene.replace(switching_frequency=frequency)
    axis.plot(occ.column_profile(each)[:400], label="exposure integral")
    try:
        axis.plot(occ.band_profile(each)[:400], "--", label="band model")
    except occ.BandModelUndefined as refusal:
        refusals[frequency] = str(refusal)
    axis.set_title(f"{frequency / 1e3:.0f} kHz, t / t_LED = {136e-6 * frequency:.2f}")
    axis.set_ylabel("grey level")
axes[0].legend(loc="upper right")
axes[-1].set_xlabel("column")
figure.tight_layout()
plt.show()

# %%
for sentence in refusals.values():
    print(sentence)

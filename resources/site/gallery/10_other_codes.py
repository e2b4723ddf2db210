# %% [markdown]
# # A text, by other codes
#
# A panel can send a text by any line code and framing. A denser line code makes a shorter message:
# more of it fits into the picture.

# %%
import matplotlib.pyplot as plt

import occ_model as occ

base = occ.load_preset("phone-68us").replace(
    payload="text:HELLO", framing="c-ook", switching_frequency=8e3, distance=0.6
)
line_codes = ("manchester", "4b6b")
chips, texts = {}, {}
for name in line_codes:
    scene = base.replace(line_code=name)
    chips[name] = occ.packet(scene)
    texts[name] = occ.decode(occ.render(scene).image, scene).payload
    print(f"{name}: {len(chips[name])} chips, received {texts[name]!r}")

# %%
figure, axes = plt.subplots(len(line_codes), 1, sharex=True, figsize=(8, 3))
for axis, name in zip(axes, line_codes, strict=True):
    axis.step(range(len(chips[name])), chips[name], where="post", linewidth=0.9)
    axis.set(ylabel=name, yticks=[])
axes[-1].set_xlabel("chip")
figure.tight_layout()
plt.show()

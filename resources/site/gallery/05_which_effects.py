# %% [markdown]
# # Which effects a scene calls for
#
# For every effect of a real camera the program knows a bound: by how much the picture can change if
# the effect is left out. The plan leaves out the smallest, as long as the sum of what it leaves out
# stays within the tolerance.

# %%
import matplotlib.pyplot as plt

import occ_model as occ

scene = occ.load_preset("phone-136us-real")
plan = occ.plan(scene, tolerance=0.5, observable="profile")
for decision in plan.decisions:
    print(f"{decision.label}: {decision.reason}")

# %%
decisions = sorted(plan.decisions, key=lambda decision: decision.estimate)
figure, axis = plt.subplots(figsize=(8, 3.5))
colours = ["C0" if decision.included else "lightgrey" for decision in decisions]
labels = [decision.label for decision in decisions]
axis.barh(labels, [max(decision.estimate, 1e-3) for decision in decisions], color=colours)
axis.axvline(0.5, color="black", linewidth=0.8)
axis.set_xscale("log")
axis.set_xlabel("bound in levels of the stretched profile (line: the tolerance)")
figure.tight_layout()
plt.show()

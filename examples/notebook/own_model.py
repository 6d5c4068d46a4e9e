"""A model of one's own against the paper's, cell by cell."""

# %% [markdown]
# # A model of one's own against the paper's
# Run cell by cell in an editor that knows `# %%`, or turn it into a notebook with jupytext. From the top of a clone.

# %%
import numpy as np

import tread_validate as tv

study = tv.load_study("config/study.yaml")
case = study.case("rig-rectangle-22c-0p2mm-300rpm")


# %% [markdown]
# A model is a function from a case to time (s), normal force and, if known, tangential force (N). Here half a sine.


# %%
def half_sine(case_file):
    """Return a half sine of 100 N over the first 90 % of the pass."""
    time = np.linspace(0.0, case_file.expected_duration_s, 400)
    contact = 0.9 * case_file.expected_duration_s
    return time, 100.0 * np.sin(np.pi * np.minimum(time / contact, 1.0))


# %%
mine, paper = tv.run(case, half_sine), tv.run(case, "paper")
rows = tv.compare(paper, mine)
print(mine, paper, rows, sep="\n")

# %%
axes = paper.plot()
mine.plot(axes)

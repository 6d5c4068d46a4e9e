"""The accepted baseline: what it holds, how a run differs from it, and how it is made anew."""

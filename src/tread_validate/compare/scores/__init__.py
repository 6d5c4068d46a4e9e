"""One run against another: scalars, histories on a common clock, scores, and statistics over many runs."""

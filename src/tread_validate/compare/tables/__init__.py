"""The tables of the results: what they hold, written and read in one place."""

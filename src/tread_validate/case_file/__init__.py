"""The case as data: everything a model in any language needs to compute one pass, in SI, as one JSON file."""

"""Models of the user's own: run, checked against the case, and filed like the built-in ones.

A model gets the case as data and gives back a force history. It shares no code with the spring models, the decks or the
FE engine; what it is handed is the case file (see `tread_validate.case_file`) and nothing else.
"""

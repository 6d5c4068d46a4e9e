"""How far can a tread-block model be trusted?

Decks, spring models, an explicit finite element engine and the comparison between them, for the tread block of
a free-rolling tyre (Liu, Sutcliffe and Graham, Wear 269 (2010) 672-683, doi:10.1016/j.wear.2010.07.006).
"""

__version__ = "0.1.0"

"""Rung `coupled`: the block's face as springs that know their neighbours, condensed from one static elastic solve."""

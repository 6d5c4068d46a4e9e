"""Level `condensed`: the block's face as springs that know their neighbours, from one static elastic solve."""

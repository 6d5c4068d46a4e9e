"""CalculiX as a second engine for elastic blocks with Coulomb friction."""

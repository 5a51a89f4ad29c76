"""How fast the package is, beside its peers and beside the same arithmetic in C."""

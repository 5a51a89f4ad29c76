"""How fast the package is beside other packages and beside the same arithmetic in C."""

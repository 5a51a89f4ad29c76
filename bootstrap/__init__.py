"""What lab.py needs before there is an environment; only the standard library is used."""

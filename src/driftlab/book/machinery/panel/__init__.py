"""How slider panels are made."""

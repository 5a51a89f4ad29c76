"""How figures are made: tables, drawings, files."""

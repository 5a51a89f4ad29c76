"""Chapter 19, the equation ledger and glossary: its puzzle; the rest shows what the others hold."""

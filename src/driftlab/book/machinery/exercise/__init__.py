"""How exercises and puzzles are asked, judged and kept."""

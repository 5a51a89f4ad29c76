"""What chapter 13 makes of published recordings: numbers, not yet pictures."""

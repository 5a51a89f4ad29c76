"""What the chapters are made with."""

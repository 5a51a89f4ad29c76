"""Bare computations on arrays of floats: nothing is checked here.

A public function checks its arguments once and calls a core; cores call cores. So a filter of a
thousand steps does not look a hundred thousand times at arrays that the package itself has made.
"""

"""Settings of all tests: property tests draw the same examples everywhere, without a clock."""

from hypothesis import settings

settings.register_profile("driftlab", derandomize=True, deadline=None, max_examples=60)
settings.load_profile("driftlab")

"""What every step of the build says when it cannot go on."""


class Unfinished(Exception):
    """The site, or a part of it, cannot be made; the sentence says why."""

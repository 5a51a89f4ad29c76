"""The published figure that a test is about."""

import pytest

from driftlab.book.machinery.publish import PublishedFigure
from published import computed


@pytest.fixture
def figure(request: pytest.FixtureRequest) -> PublishedFigure:
    """The figure that `published` names."""
    return computed(request.param)

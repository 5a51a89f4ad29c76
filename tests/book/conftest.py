"""The published figure that a test is about."""

import pytest

from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.book.machinery.panel.matplotlib_view import MatplotlibView
from published import computed


@pytest.fixture
def figure(request: pytest.FixtureRequest) -> PublishedFigure:
    """The figure that `published` names."""
    return computed(request.param)


@pytest.fixture
def no_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    """Panels bring their pictures up to date and do not draw them, which takes longest.

    A panel that is `opened` afterwards draws.
    """
    monkeypatch.setattr(MatplotlibView, "_jpeg", lambda view: b"")

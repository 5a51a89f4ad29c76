"""What a published figure is."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .picture import Picture


@dataclass(frozen=True)
class Entry:
    """One published figure.

    Attributes
    ----------
    name : str
        File name without ending; begins with the chapter's number.
    compute : callable
        Takes nothing, returns the picture's data.
    picture : type of Picture
    columns : callable or None
        Data to CSV columns of equal length; None for a drawing that shows no numbers.
    caption : callable
        Data to the sentence under the figure, so that its numbers are computed.
    """

    name: str
    compute: Callable[[], Any]
    picture: type[Picture[Any]]
    columns: Callable[[Any], dict[str, Any]] | None
    caption: Callable[[Any], str]

from . import (
    publishers as publishers,
    recording as recording,
)
from .publishers import (
    PUBLISHED as PUBLISHED,
    PublishedSet as PublishedSet,
    RecordingUnavailable as RecordingUnavailable,
    ferraris_sections as ferraris_sections,
    published as published,
    published_file as published_file,
)
from .recording import Recording as Recording

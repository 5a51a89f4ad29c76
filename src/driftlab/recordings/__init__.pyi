from . import (
    channels as channels,
    csv_reader as csv_reader,
    gravity_turns as gravity_turns,
    guards as guards,
    imu_tk_reader as imu_tk_reader,
    psins_reader as psins_reader,
    publishers as publishers,
    recording as recording,
    text_table as text_table,
    time_stamps as time_stamps,
    units as units,
)
from .csv_reader import read_csv as read_csv
from .guards import (
    RULES as RULES,
    Doubt as Doubt,
    doubts as doubts,
    without_doubts as without_doubts,
)
from .imu_tk_reader import read_imu_tk as read_imu_tk
from .psins_reader import (
    PsinsHeader as PsinsHeader,
    psins_header as psins_header,
    read_psins as read_psins,
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

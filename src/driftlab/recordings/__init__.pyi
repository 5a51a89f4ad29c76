from . import (
    catalogue as catalogue,
    dataframes as dataframes,
    guards as guards,
    layout as layout,
    publishers as publishers,
    readers as readers,
    recording as recording,
    static_detection as static_detection,
)
from .catalogue import PUBLISHED as PUBLISHED
from .dataframes import from_dataframe as from_dataframe
from .guards import RULES as RULES, data_problems as data_problems
from .layout import Layout as Layout
from .publishers import (
    RecordingUnavailable as RecordingUnavailable,
    ferraris_sections as ferraris_sections,
    published as published,
    published_file as published_file,
)
from .readers import read_csv as read_csv, read_imu_tk as read_imu_tk, read_psins as read_psins
from .recording import Recording as Recording
from .static_detection import static_intervals as static_intervals

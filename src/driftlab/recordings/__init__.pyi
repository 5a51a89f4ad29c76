from . import (
    catalogue as catalogue,
    channels as channels,
    csv_reader as csv_reader,
    dataframes as dataframes,
    guards as guards,
    imu_tk_reader as imu_tk_reader,
    psins_reader as psins_reader,
    publishers as publishers,
    recording as recording,
    rest_detection as rest_detection,
    turns_of_gravity as turns_of_gravity,
    units as units,
)
from .catalogue import (
    PUBLISHED as PUBLISHED,
    PublishedSet as PublishedSet,
)
from .channels import (
    clipped_rows as clipped_rows,
    dead_channels as dead_channels,
    longest_run as longest_run,
    twin_channels as twin_channels,
)
from .csv_reader import read_csv as read_csv
from .dataframes import from_dataframe as from_dataframe
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
    RecordingUnavailable as RecordingUnavailable,
    ferraris_sections as ferraris_sections,
    published as published,
    published_file as published_file,
)
from .recording import Recording as Recording
from .rest_detection import (
    Rests as Rests,
    rests as rests,
)
from .turns_of_gravity import (
    GravityTurns as GravityTurns,
    gravity_turns as gravity_turns,
)
from .units import (
    ACCELEROMETER_UNITS as ACCELEROMETER_UNITS,
    GYRO_UNITS as GYRO_UNITS,
    TIME_UNITS as TIME_UNITS,
    Unit as Unit,
    accelerometer_unit as accelerometer_unit,
    gyro_unit as gyro_unit,
    is_unit as is_unit,
    time_unit as time_unit,
)

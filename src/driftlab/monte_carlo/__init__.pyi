from . import (
    bounds as bounds,
    sweeps as sweeps,
    workers as workers,
)
from .bounds import (
    mean_square_bounds as mean_square_bounds,
)
from .sweeps import (
    running_on as running_on,
    sweep as sweep,
)
from .workers import (
    cluster as cluster,
    cores as cores,
    processes as processes,
)

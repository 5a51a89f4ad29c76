from . import (
    causes as causes,
    slips as slips,
)
from .causes import (
    Diagnosis as Diagnosis,
    diagnose as diagnose,
)

from . import recording as recording
from .recording import Recording as Recording

from . import (
    forms as forms,
    imu_tk as imu_tk,
    imucal as imucal,
    kalibr as kalibr,
    nominal_readings as nominal_readings,
    psins as psins,
    ros as ros,
)
from .forms import (
    bias_behind_matrix as bias_behind_matrix,
    inverse as inverse,
    matrix_before_bias as matrix_before_bias,
    refuse_unless_zero as refuse_unless_zero,
)
from .imu_tk import ImuTkMatrices as ImuTkMatrices
from .imucal import ImucalMatrices as ImucalMatrices
from .kalibr import KalibrMatrices as KalibrMatrices
from .nominal_readings import (
    SI_READINGS as SI_READINGS,
    NominalReadings as NominalReadings,
)
from .psins import PsinsMatrices as PsinsMatrices
from .ros import RosMatrices as RosMatrices

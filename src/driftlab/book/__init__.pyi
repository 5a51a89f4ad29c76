from . import scenarios as scenarios
from .ch01_attitude_error_motion.panels import ErrorMotionExplorer as ErrorMotionExplorer
from .ch01_attitude_error_motion.scenes import FalseRate as FalseRate
from .ch02_characteristic_equation.panels import RootsExplorer as RootsExplorer
from .ch03_systematic_drift.globe import GlobeOfAxes as GlobeOfAxes
from .ch03_systematic_drift.panels import DriftExplorer as DriftExplorer
from .ch03_systematic_drift.scenes import TurningBlock as TurningBlock
from .ch04_calibration_by_turns.panels import TurnCalibrationExplorer as TurnCalibrationExplorer
from .ch04_calibration_by_turns.scenes import FourMountings as FourMountings
from .ch05_rate_table_on_earth.panels import EarthTurnsExplorer as EarthTurnsExplorer
from .ch06_attitude_in_three_numbers.panels import CayleyMapExplorer as CayleyMapExplorer
from .ch06_attitude_in_three_numbers.scenes import LampAndShadow as LampAndShadow
from .ch07_coning.panels import (
    AlgorithmLaboratoryExplorer as AlgorithmLaboratoryExplorer,
)
from .ch07_coning.scenes import ShakingBracket as ShakingBracket
from .ch07_coning.square import SquareThatDoesNotClose as SquareThatDoesNotClose
from .ch09_strapdown_navigation.panels import MissionExplorer as MissionExplorer
from .ch10_misalignment.panels import SplitExplorer as SplitExplorer
from .ch10_misalignment.scenes import TwoTables as TwoTables
from .ch11_kalman_calibration.panels import (
    CalibrationRunExplorer as CalibrationRunExplorer,
    ObservabilityExplorer as ObservabilityExplorer,
)
from .ch11_kalman_calibration.scenes import TurningTable as TurningTable
from .ch12_calibration_consistency.panels import ConsistencyExplorer as ConsistencyExplorer
from .ch13_finding_north.panels import AlignmentBudgetExplorer as AlignmentBudgetExplorer
from .ch13_finding_north.scenes import (
    BowOverTheTop as BowOverTheTop,
    BoxOnTheWayNorth as BoxOnTheWayNorth,
)
from .ch14_gyrocompass_under_way.panels import GyrocompassExplorer as GyrocompassExplorer
from .ch14_gyrocompass_under_way.scenes import (
    SchulerPendulum as SchulerPendulum,
    ShipUnderWay as ShipUnderWay,
)
from .ch15_gyrocompass_trials.panels import TypeTestExplorer as TypeTestExplorer
from .ch16_one_triad.panels import CapstoneExplorer as CapstoneExplorer
from .ch16_one_triad.scenes import TurningShip as TurningShip
from .ch17_real_recordings.panels import AllanExplorer as AllanExplorer
from .exercises import (
    add_exercise as add_exercise,
    all_exercises as all_exercises,
    by_kind as by_kind,
    check as check,
    given as given,
    hint as hint,
    verdict as verdict,
)
from .figures import (
    figure as figure,
    figure_parameters as figure_parameters,
    measured as measured,
)
from .instructors.class_report import class_report as class_report
from .ledger import (
    SEVERITIES as SEVERITIES,
    STATUSES as STATUSES,
    ledger_entries as ledger_entries,
    paper_table as paper_table,
    summary_table as summary_table,
)
from .machinery.table import Table as Table
from .puzzles import (
    guess as guess,
    guesses as guesses,
)
from .references import (
    all_references as all_references,
    references_table as references_table,
)

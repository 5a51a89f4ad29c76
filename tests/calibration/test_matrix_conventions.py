"""Each program's own formula brings the truth back, and published results become one unit."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import degree
from scipy.spatial.transform import Rotation

from driftlab.body_frames import body_frame_rotation
from driftlab.book.ch17_real_recordings.experiments.publishers_numbers import IMU_TK
from driftlab.calibration.body_axes import imu_errors_in_frame
from driftlab.calibration.matrix_conventions import (
    ImucalMatrices,
    ImuTkMatrices,
    KalibrMatrices,
    NominalReadings,
    PsinsMatrices,
    RosMatrices,
)
from driftlab.imu import NO_ERRORS, ImuErrors
from support import EPS, largest

COUNTS = NominalReadings([1 / 4778, 1 / 4758, 1 / 4766], 32768, 1 / 415, [33123, 33276, 32360])
# The readings of an Xsens MTi relative to which IMU-TK's results are told here.
XSENS = NominalReadings(1 / 4778, 32768, 1 / 415, 32768)


def units(count=200, size=0.03):
    """Random units (count,), about three per cent wrong."""
    rng = np.random.default_rng(19)
    return ImuErrors(
        *(size * rng.standard_normal((count, *shape)) for shape in ((3,), (3, 3), (3,), (3, 3)))
    )


def truth(count=200):
    """Rates and specific forces (count, 3)."""
    rng = np.random.default_rng(20)
    return rng.standard_normal((count, 3)), 9.8 * rng.standard_normal((count, 3))


def times(matrix, vector):
    return np.einsum("...ij,...j->...i", matrix, vector)


def readings_of(errors, rate, force, nominal):
    """What the units show, in the readings of the program."""
    matrix, offset, other, zero = nominal.triads(errors)
    return times(matrix, rate) + offset, times(other, force) + zero


def lower_units():
    """Random units in body axes in which the accelerometers' matrix is zero above the diagonal."""
    return imu_errors_in_frame(units(), "accelerometers")[0]


MADE = {
    "imu-tk": (units(), ImuTkMatrices.from_imu_errors),
    "imu-tk counts": (units(), lambda errors: ImuTkMatrices.from_imu_errors(errors, COUNTS)),
    "kalibr": (lower_units(), KalibrMatrices.from_imu_errors),
    "imucal": (units(), ImucalMatrices.from_imu_errors),
    "imucal counts": (units(), lambda errors: ImucalMatrices.from_imu_errors(errors, COUNTS)),
    "psins": (units(), PsinsMatrices.from_imu_errors),
    "ros": (units(), RosMatrices.from_imu_errors),
}


@pytest.mark.parametrize("program", MADE)
def test_there_and_back_is_nothing_changed(program):
    errors, make = MADE[program]
    for back, went in zip(make(errors).imu_errors, errors, strict=True):
        # A rounding of a count, 32768 of them, is the largest there is.
        assert largest(back - went) < 3e-14


def own_formulas(program, calibration, gyro, force):
    """True rate in rad/s and specific force from readings, as the program itself has it."""
    c = calibration
    if program.startswith("imu-tk"):
        return times(c.gyro_T @ c.gyro_K, gyro - c.gyro_b), times(
            c.acc_T @ c.acc_K, force - c.acc_b
        )
    if program.startswith("imucal"):
        inverse = np.linalg.inv
        return (
            times(inverse(c.R_g) @ inverse(c.K_g), gyro - c.b_g) * degree,
            times(inverse(c.R_a) @ inverse(c.K_a), force - c.b_a),
        )
    if program == "psins":
        return times(c.Kg, gyro) - c.eb, times(c.Ka, force) - c.db
    return times(c.gyro_SM, gyro) - c.gyro_bias, times(c.SM, force) - c.bias


@pytest.mark.parametrize("program", [name for name in MADE if name != "kalibr"])
def test_the_programs_own_formula_finds_the_truth(program):
    errors, make = MADE[program]
    calibration = make(errors)
    nominal = COUNTS if program.endswith("counts") else NominalReadings()
    rate, force = truth()
    found = own_formulas(program, calibration, *readings_of(errors, rate, force, nominal))
    assert largest(found[0] - rate) < 1e-12
    assert largest(found[1] - force) < 1e-12


def test_kalibrs_formula_makes_the_measurement():
    errors = lower_units()
    kalibr = KalibrMatrices.from_imu_errors(errors)
    rate, force = truth()
    gyro, accelerometer = readings_of(errors, rate, force, NominalReadings())
    turned = times(kalibr.gyroscopes_C_gyro_i, rate)
    assert largest(times(kalibr.gyroscopes_M, turned) + kalibr.gyro_bias - gyro) < 1e-14
    made = times(kalibr.accelerometers_M, force) + kalibr.accelerometer_bias
    assert largest(made - accelerometer) < 1e-14
    for matrix in (kalibr.gyroscopes_M, kalibr.accelerometers_M):
        assert largest(np.triu(matrix, 1)) < 1e-15


# IMU-TK on its own recording: zeros below the diagonal, as its program has it, and above.
BELOW, ABOVE = (published.imu_errors for published in IMU_TK)
AXES = ("lower triangle accelerometers", BELOW), ("accelerometers", ABOVE)


def test_two_published_results_are_one_unit_in_two_body_axes():
    assert largest(BELOW.gyro_error_matrix - ABOVE.gyro_error_matrix) > 0.02
    for start, axes, goal in ((BELOW, *AXES[1]), (ABOVE, *AXES[0])):
        turned, _ = imu_errors_in_frame(start, axes)
        # Six digits of the scales are 2.4e-6 of them, five of T 5e-7.
        assert largest(turned.gyro_error_matrix - goal.gyro_error_matrix) < 4e-6
        assert largest(turned.accelerometer_error_matrix - goal.accelerometer_error_matrix) < 4e-6


def test_what_no_choice_of_axes_changes():
    """The rotation between the two triads, each without its bending; to first order the skews."""
    between = []
    for errors in (BELOW, ABOVE):
        turns = map(
            body_frame_rotation, (errors.gyro_error_matrix, errors.accelerometer_error_matrix)
        )
        gyro, accelerometer = map(Rotation.from_matrix, turns)
        between.append((gyro * accelerometer.inv()).as_rotvec())
        skew = [
            np.subtract(k, k.T)[[2, 0, 1], [1, 2, 0]] / 2
            for k in (errors.gyro_error_matrix, errors.accelerometer_error_matrix)
        ]
        # What is left out is the square of 0.03.
        np.testing.assert_allclose(skew[0] - skew[1], between[-1], rtol=0, atol=1e-3)
    np.testing.assert_allclose(*between, rtol=0, atol=1e-6)
    np.testing.assert_allclose(between[0][:2], [-0.0148, 0.0075], rtol=0, atol=1e-4)


def test_factory_sheet_is_imu_tks_result_within_its_rounding():
    """The sheet has two decimals, and rows that are the sensitive axes: it makes errors, as we do.

    In axes of one triangle an entry is a sum of two of the sheet, each rounded by 0.005, for the
    gyros of three. With the rows taken for the inverse the gyros are wrong by more than 0.05.
    """
    accelerometers = np.array([[1, 0, -0.01], [0.01, 1, 0.01], [0.02, 0.01, 1]])
    gyros = np.array([[1, -0.01, -0.02], [0, 1, 0.04], [-0.01, 0.01, 1]])
    gains = np.diag([4778, 4758, 4766]), np.diag([415, 413, 415])
    offset, gyro_b = (33123, 33276, 32360), IMU_TK[0].gyro_b
    sheet = XSENS.imu_errors(gains[0] @ gyros, gyro_b, gains[1] @ accelerometers, offset)
    inverse = XSENS.imu_errors(
        gains[0] @ np.linalg.inv(gyros), gyro_b, gains[1] @ np.linalg.inv(accelerometers), offset
    )
    for axes, published in AXES:
        turned, _ = imu_errors_in_frame(sheet, axes)
        assert (
            largest(turned.accelerometer_error_matrix - published.accelerometer_error_matrix)
            < 0.010
        )
        assert largest(turned.gyro_error_matrix - published.gyro_error_matrix) < 0.015
        assert largest(turned.accelerometer_bias - published.accelerometer_bias) < 0.02
        wrong, _ = imu_errors_in_frame(inverse, axes)
        assert largest(wrong.gyro_error_matrix - published.gyro_error_matrix) > 0.05


# mad-lab-fau/imucal at 8716e4c, example_data/legacy_calibration_pre_2.0.json: counts of 16 bits,
# 2000 deg/s and 16 g of 9.81 m/s^2 at the end of the range.
FERRARIS = ImucalMatrices(
    np.diag([208.0872101632679, 209.27545798890046, 213.65073106754224]),
    [
        [0.9998620291746435, -0.01483057100492679, -0.007481763056406507],
        [0.008576740442555634, 0.9999615197419686, 0.001843518026355982],
        [0.013331187730679013, 0.002003617949970859, 0.999909128345571],
    ],
    [112.13215955810813, -128.64258204284693, 83.27016485374816],
    np.diag([16.84151216420952, 16.09609664670747, 16.356319026301364]),
    [
        [0.9999793425280371, -0.00045421361799804144, -0.006411568231274508],
        [-0.00022220540636464127, 0.9999961009525418, -0.002783649487862619],
        [0.00971400449849657, 0.00764109329294033, 0.9999236229882219],
    ],
    [-9.824970828471413, -6.05950991831972, 0.9629521586931156],
    [
        [0.006383388123673677, -0.007506418795761887, -0.0004889775217182036],
        [0.007078089693795729, 0.0079808097411764, 0.010123020998329641],
        [0.0016329203640659267, -0.0014926956472095258, 0.003860846398736716],
    ],
    NominalReadings(
        gyro_scale_factor=2000 * degree / 2**15, accelerometer_scale_factor=16 * 9.81 / 2**15
    ),
)
# ethz-asl/kalibr, issue 189.
ISSUE_189 = KalibrMatrices(
    [[0.98064672, 0, 0], [-0.01260154, 1.01224075, 0], [-0.01087295, 0.00237432, 1.00600802]],
    [[0.99732203, 0, 0], [0.00373207, 0.99372249, 0], [-0.00218998, -0.00186741, 0.99919668]],
    [
        [0.99999949, 0.00071135, 0.00071417],
        [-0.00071004, 0.99999806, -0.00183835],
        [-0.00071547, 0.00183784, 0.99999806],
    ],
    [
        [-0.00075474, 0.00162226, 0.00019704],
        [-0.00346093, -0.00023962, -0.00694434],
        [-0.00216607, 0.00254173, 0.00037087],
    ],
)


def test_imucals_example_is_the_diagonal_that_it_is_known_for():
    with pytest.raises(ValueError, match=r"^K_ga: expected zeros, .* got up to 0\.0101; take"):
        FERRARIS.imu_errors  # noqa: B018
    errors = replace(FERRARIS, K_ga=np.zeros((3, 3))).imu_errors
    known = [0.02790, -0.01758, -0.00177]
    np.testing.assert_allclose(np.diag(errors.gyro_error_matrix), known, rtol=0, atol=6e-6)
    back = ImucalMatrices.from_imu_errors(errors, FERRARIS.readings)
    for name in ("K_a", "R_a", "b_a", "K_g", "R_g", "b_g"):
        np.testing.assert_allclose(getattr(back, name), getattr(FERRARIS, name), rtol=1e-12)


def test_kalibrs_issue_189_goes_there_and_back():
    with pytest.raises(ValueError, match=r"^gyroscopes_A: expected zeros, .* up to 0\.00694; take"):
        ISSUE_189.imu_errors  # noqa: B018
    without = replace(ISSUE_189, gyroscopes_A=np.zeros((3, 3)))
    back = KalibrMatrices.from_imu_errors(without.imu_errors)
    for name in ("accelerometers_M", "gyroscopes_M", "gyroscopes_C_gyro_i"):
        # Eight decimals of a rotation matrix are no rotation any more.
        assert largest(np.subtract(getattr(back, name), getattr(without, name))) < 2e-8


def test_bias_behind_the_matrix_is_another_one():
    errors = NO_ERRORS._replace(
        gyro_error_matrix=np.array([[0, 0.1, 0], [0, 0, 0], [0, 0, 0]]),
        gyro_bias=np.array([0, 1.0, 0]),
    )
    np.testing.assert_allclose(PsinsMatrices.from_imu_errors(errors).eb, [-0.1, 1, 0], atol=1e-15)
    np.testing.assert_array_equal(ImuTkMatrices.from_imu_errors(errors).gyro_b, [0, 1, 0])


def test_realsense_writes_its_matrix_column_by_column():
    """Its tool solves ``[m, -1] X = true`` and writes X row by row, so SM is the transpose."""
    errors = ImuErrors(*(field[0] for field in units(1)))
    rng = np.random.default_rng(3)
    true = 9.8 * rng.standard_normal((20, 3))
    measured = readings_of(errors, np.zeros((20, 3)), true, NominalReadings())[1]
    solution = np.linalg.lstsq(np.column_stack([measured, -np.ones(20)]), true)[0].ravel()
    ros = RosMatrices(np.reshape(solution[:9], (3, 3)).T, solution[9:], np.zeros(3))
    assert (
        largest(ros.imu_errors.accelerometer_error_matrix - errors.accelerometer_error_matrix)
        < 1e-13
    )
    assert largest(ros.imu_errors.accelerometer_bias - errors.accelerometer_bias) < 1e-13


EYE, ZERO = np.eye(3), np.zeros(3)


def test_gyros_that_imu_calib_knows_no_matrix_of_lose_their_bias_only():
    bias = np.array([0.01, -0.02, 0.03])
    found = RosMatrices(0.9 * EYE, ZERO, bias).imu_errors
    np.testing.assert_array_equal(found.gyro_error_matrix, np.zeros((3, 3)))
    np.testing.assert_allclose(found.gyro_bias, bias, rtol=8 * EPS)  # 1/0.9 and back is rounded


SENTENCES = {
    "counts taken for SI": (
        lambda: ImuTkMatrices(EYE, 0.0024 * EYE, ZERO, EYE, EYE, ZERO).imu_errors,
        r"^accelerometer_matrix: expected sensors that read 0\.2 to 5 times .* got 417 times",
    ),
    "turns the other way": (  # imucal's own tests have such a result, R_g near minus one
        lambda: ImucalMatrices(EYE, EYE, ZERO, EYE * degree, -EYE, ZERO).imu_errors,
        r"^gyro_matrix: expected .* got -1 times; .* turn the axes round\.$",
    ),
    "singular": (
        lambda: PsinsMatrices(EYE, ZERO, np.ones((3, 3)), ZERO).imu_errors,
        "^Ka: expected a matrix with an inverse, got a singular one",
    ),
    "size effect": (
        lambda: KalibrMatrices(EYE, EYE, EYE, ry_i=[0.0, 0.02, 0.0]).imu_errors,
        r"^ry_i: expected zeros, .* got up to 0\.02",
    ),
    "squares": (
        lambda: PsinsMatrices(EYE, ZERO, EYE, ZERO, Ka2=[1e-6, 0, 0]).imu_errors,
        "^Ka2: expected zeros",
    ),
    "no rotation": (
        lambda: KalibrMatrices(EYE, EYE, 1.1 * EYE).imu_errors,
        "^gyroscopes_C_gyro_i: expected a rotation matrix",
    ),
    "not kalibr's axes": (
        lambda: KalibrMatrices.from_imu_errors(units()),
        "^accelerometer_error_matrix: expected zeros above the diagonal, as kalibr's body axes ",
    ),
    "shape": (lambda: RosMatrices(EYE, ZERO, [1, 2]).imu_errors, "^gyro_bias: expected shape"),
    "no scale": (
        lambda: NominalReadings(0.0).triads(NO_ERRORS),
        "^gyro_scale_factor: expected numbers",
    ),
    "four scales": (
        lambda: NominalReadings(gyro_zero=np.ones(4)).triads(NO_ERRORS),
        r"^gyro_zero: expected shape \(\) or \(3,\), got shape \(4,\)",
    ),
    "other word": (
        lambda: imu_errors_in_frame(NO_ERRORS, "left"),
        "^frame: expected one of averaged, .* accelerometers, got 'left'",
    ),
}


@pytest.mark.parametrize("case", SENTENCES)
def test_what_cannot_be_said_is_refused_with_a_sentence(case):
    call, words = SENTENCES[case]
    with pytest.raises(ValueError, match=words):
        call()


def test_a_ros_calibration_leaves_the_gyros_axes_alone_unless_told():
    force = np.diag([1.25, 1.0, 0.9]), [0.25, 0.0, 0.1], [1e-3, 2e-3, 3e-3]
    found, told = RosMatrices(*force).imu_errors, RosMatrices(*force, np.eye(3)).imu_errors
    np.testing.assert_array_equal(found.gyro_error_matrix, np.zeros((3, 3)))
    for one, other in zip(found, told, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("sensor", [0, 1, 2])
def test_each_sensor_reads_a_fifth_to_five_times_its_nominal_value(sensor):
    for gain in (0.2, 5.0):
        matrix = np.diag(np.where(np.arange(3) == sensor, gain, 1.0))
        found = NominalReadings().imu_errors(matrix, ZERO, EYE, ZERO)
        assert found.gyro_error_matrix[sensor, sensor] == gain - 1
        for beyond in (np.nextafter(gain, gain**9), -gain):
            matrix[sensor, sensor] = beyond
            for name, args in (
                ("gyro", (matrix, ZERO, EYE, ZERO)),
                ("accelerometer", (EYE, ZERO, matrix, ZERO)),
            ):
                words = "expected sensors that read 0.2 to 5 times their nominal value, got"
                with pytest.raises(ValueError, match=f"^{name}_matrix: {words} {beyond:.3g} times"):
                    NominalReadings().imu_errors(*args)

"""How well nineteen positions show 21 sensor errors: a covariance analysis without the package.

Nothing here comes from `driftlab`: the constants, the error equations, the schedule and the prior
are written down anew, and SciPy's matrix exponential makes the steps. States: attitude, velocity,
gyro bias, six of a symmetric K, accelerometer bias, nine of L; East, North, Up and SI units.
"""

import numpy as np
from scipy.linalg import block_diag, expm
from scipy.spatial.transform import Rotation

LATITUDE = np.radians(37.5)
EARTH = 7.292115e-5 * np.array([0.0, np.cos(LATITUDE), np.sin(LATITUDE)])  # rad/s
GRAVITY = (
    9.780325
    * (1 + 0.00193185 * np.sin(LATITUDE) ** 2)
    / np.sqrt(1 - 0.00669438 * np.sin(LATITUDE) ** 2)
)  # Somigliana, m/s^2
RADIUS = 6.371e6  # m; 40 minutes do not tell a sphere from an ellipsoid
ARC_SECOND, HOUR = np.radians(1 / 3600), 3600.0
GYRO_WALK, PUSH_WALK = np.radians(0.005) / 60, 5e-6 * 9.80665  # rad/sqrt(s), (m/s)/sqrt(s)
VELOCITY_NOISE = 0.01  # m/s, once a second
TURNS = (  # body axis and quarter turns, after Xie Bo
    (1, 1), (1, 1), (1, 1), (1, -1), (1, -1), (1, -1), (2, 1), (0, 1), (0, 1), (0, 1),
    (0, -1), (0, -1), (0, -1), (2, 1), (2, 1), (2, -1), (2, -1), (2, -1),
)  # fmt: skip
PAUSE, QUARTER = 120, 9  # s
OFF = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]
PAIRS = [(0, 1), (0, 2), (1, 2)]


def cross(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def error_rates(attitude, spin):
    """F (27, 27): matrix from body axes, and rate of the table about the body's axes."""
    omega, force = attitude.T @ EARTH + spin, attitude.T @ [0.0, 0.0, GRAVITY]
    symmetric = np.array([np.eye(3)[i] * omega[j] + np.eye(3)[j] * omega[i] for i, j in PAIRS]).T
    entries = np.array([np.eye(3)[i] * force[j] for i, j in OFF]).T
    rates = np.zeros((27, 27))
    rates[:3, :3] = -cross(EARTH)
    rates[:3, 3:6] = np.array([[0, -1, 0], [1, 0, 0], [np.tan(LATITUDE), 0, 0]]) / RADIUS
    rates[:3, 6:15] = -attitude @ np.hstack([np.eye(3), np.diag(omega), symmetric])
    rates[3:6, :3] = cross(attitude @ force)
    rates[3:6, 3:6] = -2 * cross(EARTH)
    rates[3:6, 15:] = attitude @ np.hstack([np.eye(3), np.diag(force), entries])
    return rates


def prior(attitude, installation):
    """Covariance (27, 27) of errors that are independent in the table's axes, in averaged ones."""
    ways = np.zeros((27, 30))  # from attitude, velocity, and 12 numbers of each triad
    ways[:12, :12], ways[15:, 18:] = np.eye(12), np.eye(12)
    for column, (i, j) in enumerate(OFF, start=12):
        ways[12 + PAIRS.index((min(i, j), max(i, j))), column] = 0.5
        # The rest of the entry turns the axes, and with them attitude and accelerometers.
        turn = np.zeros((3, 3))
        turn[i, j], turn[j, i] = 0.5, -0.5
        ways[:3, column] = -attitude @ [turn[2, 1], turn[0, 2], turn[1, 0]]
        ways[21:, column] = [-turn[place] for place in OFF]
    triad = [1e-4] * 3 + [installation] * 6
    sizes = [60 * ARC_SECOND] * 3 + [0.0] * 3
    sizes += [np.radians(0.3) / HOUR] * 3 + triad + [3e-4 * 9.80665] * 3 + triad
    half = ways * sizes
    return half @ half.T


def standard_deviations(installation):
    """Standard deviations (27,) at the end, for a spread of the off-diagonal entries in rad."""
    attitude = np.eye(3)[[1, 2, 0]]  # x Up, y East, z North
    covariance = prior(attitude, installation)
    walks = block_diag(GYRO_WALK**2 * np.eye(3), PUSH_WALK**2 * np.eye(3), np.zeros((21, 21)))

    def step(rates, duration):
        nonlocal covariance
        # Van Loan: the transition, and what the noise has become by the end.
        both = expm(duration * np.block([[-rates, walks], [np.zeros((27, 27)), rates.T]]))
        onward = both[27:, 27:].T
        covariance = onward @ covariance @ onward.T + onward @ both[:27, 27:]

    def see():
        nonlocal covariance
        gain = covariance[:, 3:6] @ np.linalg.inv(
            covariance[3:6, 3:6] + VELOCITY_NOISE**2 * np.eye(3)
        )
        covariance = covariance - gain @ covariance[3:6]
        covariance = (covariance + covariance.T) / 2

    parts = 10  # of a second while the table turns
    for axis, sign in [*TURNS, (0, 0)]:
        rates = error_rates(attitude, np.zeros(3))
        for _ in range(PAUSE):
            step(rates, 1.0)
            see()
        if not sign:
            break
        spin = sign * (np.pi / 2) / QUARTER * np.eye(3)[axis]
        for _ in range(QUARTER):
            for part in range(parts):
                middle = Rotation.from_rotvec((part + 0.5) / parts * spin).as_matrix()
                step(error_rates(attitude @ middle, spin), 1 / parts)
            see()
            attitude = attitude @ Rotation.from_rotvec(spin).as_matrix()
    return np.sqrt(np.diag(covariance))

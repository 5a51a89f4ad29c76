"""Many runs on a cluster of dask.distributed: the same numbers, though a worker is killed."""

import os
import signal

import numpy as np
import pytest

from driftlab.calibration.simulation import TurntableTrial
from driftlab.monte_carlo import run_batches
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

distributed, joblib = map(pytest.importorskip, ("distributed", "joblib"))
pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")


def test_a_killed_worker_loses_and_doubles_nothing(tmp_path):
    scheme = Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=3.0)
    task = TurntableTrial(scheme, sample_interval=0.5, update_interval=3.0).run
    expected = run_batches(task, 60, seed=2, batch_size=3)
    killed, reported = [], []
    with distributed.LocalCluster(
        n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as local:

        def progress(size):
            reported.append(size)
            if not killed:
                killed.append(next(iter(local.workers.values())).pid)
                os.kill(killed[0], signal.SIGKILL)

        with distributed.Client(local), joblib.parallel_config("dask"):
            found = run_batches(task, 60, seed=2, batch_size=3, progress=progress, folder=tmp_path)
    assert reported == [3] * 20
    assert len(list(tmp_path.glob("*/*.batch"))) == 20
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one.errors, other.errors, rtol=1e-9, atol=1e-15)
        np.testing.assert_array_equal(
            one.imu_errors.gyro_error_matrix, other.imu_errors.gyro_error_matrix
        )

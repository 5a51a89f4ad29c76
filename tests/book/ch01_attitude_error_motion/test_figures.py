"""The experiments of chapter 01: errors in motion, by an integrator."""

from driftlab.book.ch01_attitude_error_motion.experiments import error_motion


def test_error_motion_integrator_keeps_its_tolerance() -> None:
    rate, measured = [0.1, 0.2, 0.1], [0.12, 0.15, 0.1]
    for tolerance in (1e-4, 1e-8):
        data = error_motion(rate, measured, tolerance=tolerance)
        # The tolerance holds for one step; the steps' errors add up at worst.
        assert data.largest_error < 2 * tolerance * len(data.integrated_time)

"""What an earlier pass over a record tells the next one: where to linearise."""

from __future__ import annotations

from driftlab.checks import FloatArray
from driftlab.core import quaternion
from driftlab.core.loops import attitudes
from driftlab.earth import earth_rate
from driftlab.increments import Increments
from driftlab.strapdown import ALGORITHM

from .calibration_history import Calibration
from .error_model import ErrorModel


def check_about(about: Calibration, model: ErrorModel, lead: tuple[int, ...]) -> None:
    """Refuse an earlier pass that is of another model or of other runs."""
    if about.model is not model or about.state.shape[:-2] != lead:
        raise ValueError(
            f"about: expected runs {lead} with {_described(model)}, "
            f"got {about.state.shape[:-2]} with {_described(about.model)}."
        )


def _described(model: ErrorModel) -> str:
    """Words for a model: axes, size and what was added."""
    added = f", with {', '.join(model.higher_order)}" if model.higher_order else ""
    return f"the model {model.frame!r} of {model.size} states{added}"


def linearization_point(
    measured: Increments, latitude: float, about: Calibration
) -> tuple[FloatArray, FloatArray]:
    """State (..., size) that a pass found, and the attitude (..., 4) that it found for the start:
    that at the end is known best, and the corrected gyros lead back from it."""
    state = about.state[..., -1, :]
    angle = about.model.corrected(measured, state).angle
    turned = attitudes(ALGORITHM, angle)[..., -1, :]
    # In axes that do not turn with the Earth: those of the beginning.
    at_end = quaternion.from_rotation_vector(about.times[-1] * earth_rate(latitude))
    return state, quaternion.multiply(
        quaternion.multiply(at_end, about.attitude[..., -1, :]), quaternion.conjugate(turned)
    )

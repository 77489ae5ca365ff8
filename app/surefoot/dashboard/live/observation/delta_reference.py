"""What the delta_P reference of some settings will do, computed once when they change."""

from surefoot.control.delta_reference import admissible_intervals, standing_prediction
from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.messages.snapshot import BiasView
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import PostureError
from surefoot.number_text import figure
from surefoot.task.reference import TaskReference


def bias_of(settings: ControllerSettings) -> tuple[float, float]:
    """Frontal and sagittal delta_P^ref [N m]."""
    return settings.delta_ref_frontal_nm, settings.delta_ref_sagittal_nm


def bias_view(dynamics: DynamicsModel, posture: TaskReference, settings: ControllerSettings) -> BiasView:
    """Admissible intervals, predicted displacement, and which component lies outside."""
    bias = bias_of(settings)
    try:
        intervals = admissible_intervals(dynamics, posture, settings)
        forward, left = (1e3 * standing_prediction(dynamics, posture, settings)).tolist()
    except PostureError:
        return BiasView(reference_nm=bias, frontal_nm=None, sagittal_nm=None, displacement_mm=(0.0, 0.0), outside=())
    frontal, sagittal = ((interval.low_nm, interval.high_nm) for interval in intervals)
    outside = tuple(
        f"{name} {value:g} N m (admissible {figure(interval.low_nm)} to {figure(interval.high_nm)})"
        for name, value, interval in zip(("frontal", "sagittal"), bias, intervals, strict=True)
        if not interval.contains(value)
    )
    return BiasView(
        reference_nm=bias, frontal_nm=frontal, sagittal_nm=sagittal, displacement_mm=(forward, left), outside=outside
    )

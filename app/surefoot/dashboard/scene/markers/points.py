"""Points of the ground: measured ZMP, commanded ZMP, capture point."""

from surefoot.dashboard.scene.marker_meshes import disc, ring
from surefoot.dashboard.scene.markers.marker import PointMarker
from surefoot.dashboard.ui import symbols


class ZmpMarker(PointMarker):
    """The measured ZMP."""

    key = symbols.ZMP.key
    label, symbol, colour = "ZMP measured", "●", symbols.ZMP.colour
    help = "centre of pressure of the ground forces"
    point = symbols.ZMP
    part = disc(0.013, 0.006), colour
    lift_m = 0.005


class ZmpCommandedMarker(PointMarker):
    """The commanded ZMP."""

    key = symbols.ZMP_COMMANDED.key
    label, symbol, colour = "ZMP commanded ζ", "◯", symbols.ZMP_COMMANDED.colour
    help = "where the controller wants the ZMP, after margin and guard"
    point = symbols.ZMP_COMMANDED
    part = ring(0.019, 0.025, 0.005), colour
    lift_m = 0.004


class CaptureMarker(PointMarker):
    """The capture point (DCM)."""

    key = symbols.CAPTURE.key
    label, symbol, colour = "Capture point (DCM)", "◆", symbols.CAPTURE.colour
    help = "G + velocity / ω: once outside the support polygon, balance is lost"
    point = symbols.CAPTURE
    part = disc(0.019, 0.005, sides=4), colour
    lift_m = 0.003

"""Surefoot: how a biped keeps its balance on bad ground.

The rooms of the house, left to right; each is used by the ones to its right and never the other way round:

    geometry, errors -> robot -> dynamics -> {momentum | task} -> gait -> control -> simulation ->
    experiments -> dashboard;    dynamics -> estimation -> simulation

==============  ==================================================================================
``geometry``    rotations, small vectors, convex polygons
``robot``       what the robot *is*: joints by name, limits, feet, state
``dynamics``    what its physics *says* at one state, evaluated once a tick into one frozen bundle
``momentum``    the balance quantity: delta_P, ZMP, capture point and the physical limits
``task``        the motion quantity: kappa(q), references, the tracking law, postures
``gait``        *where the feet go*: footsteps, the way of ZMP and capture point, which foot carries when
``estimation``  what the robot *believes*: from the readings of its sensors to a state
``control``     what the robot *decides*: settings, the QP, the ankle law, the controllers
``simulation``  the *world*: MuJoCo plant, stones, pushes, the loop, the recorder
``experiments`` the *questions*: scenario files, runs, studies, the bench, the paper's figures
``dashboard``   the *window*: session thread, commands in, snapshots out, panels and 3D scene
``cli``         the command line
==============  ==================================================================================

One control tick, left to right: ``plant.sense()`` -> ``RobotState`` and ``FootSensing`` -> ``DynamicsModel.evaluate``
-> ``DynamicsTerms`` -> ``reference.at(t)``, or ``gait.tick`` -> ``Controller.tick`` -> ``ControlOutput``
-> ``plant.step(torques)`` -> ``Recorder``. With an estimator, ``plant.signals()`` -> ``Sensors`` -> ``SensorReadings``
-> ``Estimator`` -> the ``RobotState`` and ``FootSensing`` that gait and controller get.

World frame: x forward, y to the left, z up. SI units everywhere. Equation numbers are those of Rojas-Estrada, Marot,
Sardain and Bessonnet, *Applied Bionics and Biomechanics* 2(2), 2005; ``surefoot equations`` lists who owns which.

The names for users stand in ``__all__``: ``surefoot.run``, ``surefoot.open_run``, ... Each is imported when it is first
asked for: ``import surefoot`` alone loads neither MuJoCo nor viser.
"""

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

# Where the names for users come from
_PUBLIC = {
    # runs
    "run": "api",
    "open_run": "api",
    "Run": "api",
    "load_scenario": "experiments.scenario.scenario",
    "shipped_scenarios": "experiments.scenario.scenario",
    "Scenario": "experiments.scenario.scenario",
    "controllers": "control.registry",
    "InvalidInput": "errors",
    "SurefootError": "errors",
    # what a controller of your own is made of
    "ControllerEntry": "control.registry",
    "ControllerSettings": "control.settings",
    "ControlOutput": "control.interface",
    "FootSensing": "robot.sensing",
    "Status": "control.interface",
    "DynamicsTerms": "dynamics.terms",
    "RobotDescription": "robot.description",
    "TaskReference": "task.reference",
    # and what it may be built from
    "GainTable": "control.task_acceleration",
    "acceleration_response": "control.task_acceleration",
    "commanded_output_acceleration": "control.task_acceleration",
    "support_geometry": "control.balance.support",
    "move_zmp": "control.balance.zmp_demand",
    "required_wrench": "control.balance.contact_wrench",
    "share_between_feet": "control.balance.contact_wrench",
    "joint_torques": "control.balance.contact_wrench",
    "capture_point": "momentum.zmp",
    "natural_frequency": "momentum.zmp",
    "delta_about": "momentum.delta",
    "momentum_rate": "momentum.delta",
    "project_onto_halfplanes": "geometry.polygon",
}
__all__ = sorted(_PUBLIC)  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    if name not in _PUBLIC:
        raise AttributeError(
            f"module {__name__!r} has no attribute {name!r}; the names for users: {', '.join(__all__)}"
        )
    value = getattr(import_module(f"{__name__}.{_PUBLIC[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})

"""Surefoot: how a biped keeps its balance on bad ground.

The rooms of the house, left to right; each is used by the ones to its right and never the other way round:

    geometry, errors -> robot -> dynamics -> {momentum | task} -> control -> simulation -> experiments -> dashboard

==============  ==================================================================================
``geometry``    rotations, small vectors, convex polygons
``robot``       what the robot *is*: joints by name, limits, feet, state
``dynamics``    what its physics *says* at one state, evaluated once a tick into one frozen bundle
``momentum``    the balance quantity: delta_P, ZMP, capture point and the physical limits
``task``        the motion quantity: kappa(q), references, the tracking law, postures
``control``     what the robot *decides*: settings, the QP, the ankle law, the controllers
``simulation``  the *world*: MuJoCo plant, stones, pushes, the loop, the recorder
``experiments`` the *questions*: scenario files, runs, studies, the bench, the paper's figures
``dashboard``   the *window*: session thread, commands in, snapshots out, panels and 3D scene
``cli``         the command line
==============  ==================================================================================

One control tick, left to right: ``plant.sense()`` -> ``RobotState`` and ``FootSensing`` -> ``DynamicsModel.evaluate``
-> ``DynamicsTerms`` -> ``reference.at(t)`` -> ``Controller.tick`` -> ``ControlOutput`` -> ``plant.step(torques)``
-> ``Recorder``.

World frame: x forward, y to the left, z up. SI units everywhere. Equation numbers are those of Rojas-Estrada, Marot,
Sardain and Bessonnet, *Applied Bionics and Biomechanics* 2(2), 2005; ``surefoot equations`` lists who owns which.
"""

__version__ = "0.1.0"

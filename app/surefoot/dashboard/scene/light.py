"""The light: one lamp that throws shadows, and a bright sky.

Viser's own default is three shadow maps and a picture of a room mirrored in every surface; drawn in software, as on a
machine without a graphics card, that costs over twice as much for each frame.
"""

import viser

_LAMP_M, _DIRECTION = (2.2, 2.6, 5.6), (-2.2, -2.3, -5.2)  # from above the usual camera, onto both robots of a twin


def light_the_scene(server: viser.ViserServer) -> None:
    """Put viser's lights out and our own on."""
    scene = server.scene
    scene.configure_default_lights(enabled=False)
    scene.add_light_hemisphere(
        "/light/sky", sky_color=(255, 255, 255), ground_color=(168, 166, 162), intensity=2.1
    )  # fmt: skip
    scene.add_light_spot(
        "/light/lamp", position=_LAMP_M, direction=_DIRECTION, intensity=85.0, distance=0.0, angle=0.5, penumbra=0.6,
        decay=2.0, cast_shadow=True,
    )  # fmt: skip

"""Kinds of settings of the controllers: fields that share unit, range and what shows them."""

from surefoot.field_metadata import number

# What the plots of ``watch`` are called is the dashboard's affair; these are their keys.
COM_PLOTS, ANKLE_PLOTS, DELTA_PLOT, MARGIN_PLOT = ("lateral", "sagittal"), ("ankles",), ("delta",), ("margins",)


def stiffness(what: str, raised: str, watch: tuple[str, ...]) -> float:
    """A gain K_P [1/s2]."""
    return number(
        60.0,
        0.0,
        400.0,
        "1/s2",
        f"K_P of {what}: pulls harder towards the reference",
        group="gains",
        equation="(23)",
        step=1.0,
        raised=raised,
        watch=watch,
    )


def damping(what: str, raised: str, watch: tuple[str, ...]) -> float:
    """A gain K_D [1/s]."""
    return number(
        14.0,
        0.0,
        60.0,
        "1/s",
        f"K_D of {what}: brakes harder",
        group="gains",
        equation="(23)",
        step=0.5,
        raised=raised,
        watch=watch,
    )


def offset(direction: str) -> float:
    """A coordinate of P [m]."""
    return number(
        0.0,
        -0.3,
        0.3,
        "m",
        f"P from the ankle centre, {direction} (with p_point = offset)",
        group="delta",
        equation="(28)",
        step=0.005,
        raised=f"delta_P is taken about a point farther {direction}",
        watch=("delta", "ankles"),
    )


def weight(default: float, what: str, watch: tuple[str, ...]) -> float:
    """A weight of the QP."""
    return number(
        default,
        1e-3,
        1e3,
        "",
        f"weight of {what} where the QP must give something up",
        group="weights",
        equation="(17)",
        raised=f"{what} is kept, the others give way",
        watch=watch,
    )

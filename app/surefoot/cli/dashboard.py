"""``surefoot dashboard``: the page."""

from dataclasses import dataclass, field

import tyro


@dataclass(frozen=True)
class Dashboard:
    """Open the page: Bip, or another robot, on one foot, controllers to toggle, stones to drop."""

    port: int | None = None
    """Port to serve on; by default the first free one from 8080."""
    host: str = "127.0.0.1"
    """Address to listen on. Anything but this machine needs --token."""
    token: str | None = None
    """Secret that a page must bring as ?token=... when the server listens on other addresses."""
    allow_origin: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Address of a proxy before the page, as the browser shows it: https://robot.example.org. May be repeated."""
    scenario: str = "stand_left"
    """Shipped scenario or TOML file to start with."""
    controller: str = "two-part"
    """Controller to start with."""
    robot: str | None = None
    """Robot to start with in place of the scenario's: its name, or the path of an MJCF, a URDF or a robot.toml."""

    def main(self) -> None:
        """Serve it."""
        from surefoot.cli.console import tell_unavailable_controllers
        from surefoot.dashboard.launch import serve

        tell_unavailable_controllers()
        serve(
            host=self.host,
            port=self.port,
            token=self.token,
            allow_origin=self.allow_origin,
            scenario=self.scenario,
            controller=self.controller,
            robot=self.robot,
        )

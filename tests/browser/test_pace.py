"""What a page is sent, as the browser receives it: no plots that nobody sees, and less when its frames are late."""

import pytest

from surefoot.dashboard.page import FRAME_S
from tests.support.visitor import window

pytestmark = pytest.mark.browser

BUSY = """() => {  // every frame takes 300 ms
  const work = () => {
    for (const end = performance.now() + 300; performance.now() < end;);
    requestAnimationFrame(work);
  };
  work();
}"""


@pytest.fixture
def frame_s():
    """The page's own rate: it is what is paced."""
    return FRAME_S


def has_plot_data(frame: bytes) -> bool:
    """Whether a frame of viser's websocket brings data of a plot."""
    return any(message["type"] == "GuiUpdateMessage" and "data" in message["updates"] for message in window(frame))


def test_plots_are_sent_while_they_are_seen_and_a_late_page_is_sent_less(screen):
    frames: list[bytes] = []
    screen.page.on("websocket", lambda socket: socket.on("framereceived", lambda frame: frames.append(frame)))
    screen.page.reload()
    screen.page.get_by_label("Controller", exact=True).wait_for()
    paces = screen.dashboard.page.paces.paces

    def pace():
        (one,) = paces.values()
        return one

    screen.tab("Plots")
    screen.wait_for(lambda: any(map(has_plot_data, frames)))
    screen.tab("Balance")
    screen.wait_for(lambda: not pace().sees("Plots"))
    frames.clear()
    screen.wait_for(lambda: len(frames) > 20 and not any(map(has_plot_data, frames[-20:])))  # some were under way

    screen.tab("Plots")
    screen.wait_for(lambda: any(map(has_plot_data, frames[-20:])))
    screen.keep("plots_seen_again")
    screen.page.evaluate(BUSY)
    screen.wait_for(lambda: pace().plots_s > 0.0 and pace().rest_s > 0.0)

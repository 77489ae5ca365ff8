"""The guide: its pictures were drawn from what stands beside them, and its table is true."""

import base64
import html
import json
import re
from pathlib import Path

import pytest

from surefoot.dashboard.panels.help.guide import (
    SECTIONS,
    equation_html,
    equations,
    owned,
    owners_html,
    picture,
    pieces,
    with_pictures,
)
from surefoot.dashboard.panels.help.keys import CAMERA_KEYS, keys_html, registered
from surefoot.equation_ledger import TITLES, owned_where, owners

ROOT = Path(__file__).resolve().parents[3]
REDRAW = "run scripts/render_equations.py"


@pytest.mark.parametrize("name", equations())
def test_a_picture_shows_its_equation_in_the_colour_of_the_text(name):
    drawn = picture(name)
    lines = re.search(r'data-lines="([^"]*)"', drawn)
    assert json.loads(html.unescape(lines.group(1))) == equations()[name]["lines"], REDRAW
    assert equations()[name]["words"] in html.unescape(drawn)
    assert set(re.findall(r'fill="([^"]*)"', drawn)) == {"currentColor"}
    assert float(re.search(r'width="(\d+)"', drawn).group(1)) < 260  # a column of 330 px, a number beside it


def test_every_equation_is_shown_once_and_numbered_as_in_the_paper():
    shown = [text for section in SECTIONS for is_equation, text in pieces(section) if is_equation]
    assert sorted(shown) == sorted(equations())
    assert {number for equation in equations().values() for number in equation["numbers"]} <= set(TITLES)
    assert "(14) – (16)" in equation_html("zeta")


def test_the_pictures_of_the_guide_are_in_its_text_as_their_files_are():
    (text,) = (text for _, text in pieces("state_estimation") if "![" in text)
    data = re.search(r"\(data:image/png;base64,([^)]+)\)", with_pictures(text)).group(1)
    assert base64.b64decode(data) == (ROOT / "static" / "believed_ghost.png").read_bytes()
    assert len(data) < 50_000  # everybody who opens the page is sent it


def test_the_table_names_files_and_functions_that_claim_the_equation():
    assert {str(number): [list(place) for place in places] for number, places in owned().items()} == owned_where(), (
        REDRAW
    )
    assert list(owned()) == list(TITLES)
    ledger = owners()
    for number, places in owned().items():
        assert places
        for file, name in places:
            assert (ROOT / "app" / file).is_file()
            module = file.removesuffix(".py").replace("/", ".")
            assert f"{module}.{name}" in {owner.qualified_name for owner in ledger[number]}
            assert f"def {name.rpartition('.')[2]}(" in (ROOT / "app" / file).read_text(encoding="utf-8")
    table = owners_html(owned())
    assert table.count("<tr><td") == len(TITLES)
    assert "surefoot/control/balance/ankle_law.py" in table


def test_every_command_with_a_key_is_listed_and_no_key_is_taken_twice(dashboard):
    rows = registered(dashboard.server.gui)
    keys = [key for key, _, _ in rows]
    assert {"Space", "N", "R", "P", "1", "O", "F", "V", "L"} <= set(keys)
    assert len(keys) == len(set(keys))
    assert not set(keys) & set("WASDQE")  # with these viser moves the camera
    listed = keys_html(rows)
    assert all(html.escape(label) in listed for _, label, _ in (*rows, *CAMERA_KEYS))

"""Text files as other editors and systems write them: read, or refused in one line that says what they seem to be."""

import pytest

from surefoot.dashboard.panels.tuning.presets import read_preset
from surefoot.errors import InvalidInput
from surefoot.experiments.bench.store import MANIFEST, read_json
from surefoot.experiments.scenario.scenario import load_scenario, parse_change
from surefoot.text_files import LARGEST_BYTES

SCENARIO = 'robot = "bip"\nsupport = "left"\nduration_s = 0.01\n'
PRESET = "[controller]\ncom_stiffness = 61.0\n"
MARK = b"\xef\xbb\xbf"

WRITTEN = {
    "with a byte-order mark": lambda text: MARK + text.encode(),
    "on Windows": lambda text: MARK + text.replace("\n", "\r\n").encode(),
    "on an old Mac": lambda text: text.replace("\n", "\r").encode(),
}
REFUSED = {
    "UTF-16": (lambda text: text.encode("utf-16"), r"not UTF-8 text \(UTF-16 with a byte-order mark"),
    "UTF-16, big-endian": (lambda text: b"\xfe\xff" + text.encode("utf-16-be"), r"\(UTF-16 with a byte-order mark"),
    "UTF-16 without a mark": (lambda text: text.encode("utf-16-le"), "zero bytes; UTF-16, or no text"),
    "UTF-32": (lambda text: text.encode("utf-32"), r"\(UTF-32 with a byte-order mark"),
    "Latin-1": (lambda text: text.encode() + "\n# Höhe".encode("latin-1"), r"byte 0xf6 in line \d; an older encoding"),
    "a picture": (lambda _: b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "not UTF-8 text"),
    "deep": (lambda text: f"{text}x = {'[' * 4000}\n".encode(), "not valid TOML: it is nested too deeply"),
    "digits": (lambda text: f"{text}x = {'1' * 5000}\n".encode(), "not valid TOML: a number has too many digits"),
    "long": (lambda text: text.encode() + b"#\n" * LARGEST_BYTES, "is too large"),
}
ODD_KEYS = {
    "deep": f"{'.'.join(['a'] * 3000)} = 1",
    "digits": f"a = 0x{'f' * 5000}",
    "long": f"a = '{'x' * 500_000}'",
    "long key": f"{'a' * 500_000} = 1",
    "key of two lines": '"a\\nb" = 1',
}


@pytest.mark.parametrize("write", WRITTEN.values(), ids=WRITTEN.keys())
def test_a_scenario_is_read_however_it_was_saved(tmp_path, write):
    file = tmp_path / "scenario.toml"
    file.write_bytes(write(SCENARIO))
    assert load_scenario(file).duration_s == 0.01


@pytest.mark.parametrize("write", WRITTEN.values(), ids=WRITTEN.keys())
def test_settings_are_read_however_they_were_saved(write):
    assert read_preset(write(PRESET)) == {"com_stiffness": 61.0}


@pytest.mark.parametrize(("write", "reason"), REFUSED.values(), ids=REFUSED.keys())
def test_another_file_is_refused_in_one_line_without_the_names_of_scenarios(tmp_path, write, reason):
    file = tmp_path / "scenario.toml"
    file.write_bytes(write(SCENARIO))
    for read in (lambda: load_scenario(file), lambda: read_preset(write(PRESET))):
        with pytest.raises(InvalidInput, match=reason) as refusal:
            read()
        assert "\n" not in str(refusal.value)
        assert "stand_left" not in str(refusal.value)


@pytest.mark.parametrize("text", ODD_KEYS.values(), ids=ODD_KEYS.keys())
def test_a_refused_value_that_is_endless_is_still_one_short_line(tmp_path, text):
    file = tmp_path / "scenario.toml"
    file.write_text(SCENARIO + text)
    with pytest.raises(InvalidInput, match="unknown key") as refusal:
        load_scenario(file)
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 1000


@pytest.mark.parametrize("value", ["[" * 4000, "1" * 5000], ids=["deep", "digits"])
def test_a_change_that_toml_cannot_read_is_a_word(value):
    assert parse_change(f"duration_s={value}") == ("duration_s", value)


def test_a_folder_and_a_name_that_no_file_can_have_are_refused(tmp_path):
    for path in (tmp_path, "a\0b"):
        with pytest.raises(InvalidInput, match="cannot be read"):
            load_scenario(path)


def test_a_scenario_is_called_by_a_name_that_can_be_printed(tmp_path):
    file = tmp_path / "caf\udce9.toml"  # Latin-1 in the name of a file
    file.write_text(SCENARIO)
    assert load_scenario(file).name == "caf?"


@pytest.mark.parametrize("text", ["{", "[]", "[" * 100_000], ids=["half", "list", "deep"])
def test_a_manifest_that_somebody_spoilt_is_refused(tmp_path, text):
    (tmp_path / MANIFEST).write_text(text)
    with pytest.raises(InvalidInput, match="holds no finished bench"):
        read_json(tmp_path, MANIFEST)

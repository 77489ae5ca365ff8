"""Bad input to the real command: exit code 2 and one clear line that names what was wrong."""

import subprocess

import pytest

from surefoot.cli.main import main

GOOD = 'robot = "bip"\nsupport = "left"\nduration_s = 0.01\n'

FILES = {
    "stone too low": (GOOD + "[[stones]]\nheight_m = -1\n", ["stones.0.height_m", "-1", "0.0003 to 0.1 m"]),
    "stone too high": (GOOD + "[[stones]]\n[[stones]]\nheight_m = 10\n", ["stones.1.height_m", "10"]),
    "gain not a number": (GOOD + "[controller]\ncom_stiffness = nan\n", ["controller.com_stiffness", "0 to 400"]),
    "malformed": ('robot = "bip\n', ["not valid TOML", "line 1"]),
    "unknown key": (GOOD + "colour = 3\n", ["colour", "unknown key", "reference"]),
    "missing key": (GOOD.replace('support = "left"', ""), ["support", "is missing", "left, right, double"]),
    "wrong type": (GOOD.replace("0.01", '"long"'), ["duration_s", "'long'", "must be a number"]),
    "unknown link": (GOOD + '[[pushes]]\nlink = "arm"\n', ["pushes.0.link", "'arm'", "com, pelvis", "trunk"]),
    "unreachable posture": (
        GOOD + "com_height_m = 1.1\n",
        ["posture", "no solution", "from 0.907 to 1.009 m"],
    ),
}
MORE_FILES = {
    "unknown setting": (GOOD + "[controller]\nsafety = true\n", ["controller.safety", "unknown setting", "guard"]),
    "no table": (GOOD + "controller = 3\n", ["controller", "must be a table, written [controller]"]),
    "no list of tables": (GOOD + "stones = 3\n", ["stones", "[[stones]]"]),
    "list of numbers": (GOOD + "pushes = [1]\n", ["pushes", "[[pushes]]"]),
    "list as a robot": (GOOD.replace('"bip"', '["bip"]'), ["robot", "no such robot", "bip"]),
    "unknown robot": (GOOD.replace('"bip"', '"../bip"'), ["robot", "no such robot", "bip"]),
    "unknown support": (GOOD.replace('"left"', '"both"'), ["support", "'both'", "left, right, double"]),
    "truth as a height": (GOOD + "com_height_m = true\n", ["com_height_m", "True", "0.5 to 1.2"]),
    "height not a number": (GOOD + "com_height_m = nan\n", ["com_height_m", "nan", "0.5 to 1.2"]),
    "endless": (GOOD.replace("0.01", "inf"), ["duration_s", "inf", "0.001 to 600 s"]),
    "huge number": (GOOD + f"[controller]\ncom_stiffness = 1{'0' * 400}\n", ["controller.com_stiffness", "0 to 400"]),
    "too many stones": (GOOD + "[[stones]]\n" * 25, ["stones", "at most 24"]),
    "stone of the page": (GOOD + "[[stones]]\ndrops = true\n", ["stones.0.drops", "page only"]),
    "nested too deeply": ("x = " + "[" * 4000 + "\n", ["not valid TOML"]),
    "empty": ("", ["robot", "is missing"]),
}
ARGUMENTS = {
    "unknown controller": (("--controller", "magic"), ["controller", "'magic'", "two-part, optimization"]),
    "no key in --set": (("--set", "guard"), ["--set", "must be key=value"]),
}
MORE_ARGUMENTS = {
    "no value in --set": (("--set", "=3"), ["--set", "must be key=value"]),
    "unknown setting in --set": (("--set", "controller.gard=false"), ["controller.gard", "unknown setting"]),
    "bad value in --set": (("--set", "duration_s=soon"), ["duration_s", "'soon'"]),
    "no such entry in --set": (("--set", "stones.3.height_m=0.01"), ["stones.3.height_m", "no such entry"]),
    "strange digit in --set": (("--set", "stones.\N{SUPERSCRIPT TWO}.height_m=1"), ["stones"]),
    "a whole entry in --set": (("--set", "stones.0=3"), ["stones.0", "needs a key"]),
    "below a value in --set": (("--set", "robot.name=x"), ["robot.name", "plain value"]),
    "unknown kind of output": (("--out", "result.xls"), ["--out", "result.xls", ".json, .csv, .npz, .parquet"]),
    "no folder for output": (("--out", "nowhere/result.json"), ["--out", "folder does not exist"]),
}


@pytest.fixture
def surefoot_here(capsys):
    """The same command in this process: what it prints and returns, without a second for its start."""

    def call(*arguments):
        with pytest.raises(SystemExit) as end:
            main([str(argument) for argument in arguments])
        printed = capsys.readouterr()
        return subprocess.CompletedProcess(arguments, end.value.code, printed.out, printed.err)

    return call


@pytest.fixture
def write(tmp_path):
    def text(content: str | bytes):
        file = tmp_path / "scenario.toml"
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return file

    return text


def assert_refused(done, fragments) -> None:
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1  # one line
    assert done.stderr.startswith("surefoot: ")
    for fragment in fragments:
        assert fragment in done.stderr


@pytest.mark.parametrize(("text", "fragments"), FILES.values(), ids=FILES.keys())
def test_bad_file_is_refused_in_one_line(surefoot, write, text, fragments):
    assert_refused(surefoot("run", write(text)), fragments)


@pytest.mark.parametrize(("text", "fragments"), MORE_FILES.values(), ids=MORE_FILES.keys())
def test_more_bad_files_are_refused_in_one_line(surefoot_here, write, text, fragments):
    assert_refused(surefoot_here("run", write(text)), fragments)


@pytest.mark.parametrize(("arguments", "fragments"), ARGUMENTS.values(), ids=ARGUMENTS.keys())
def test_bad_argument_is_refused_in_one_line(surefoot, write, arguments, fragments):
    assert_refused(surefoot("run", write(GOOD), *arguments), fragments)


@pytest.mark.parametrize(("arguments", "fragments"), MORE_ARGUMENTS.values(), ids=MORE_ARGUMENTS.keys())
def test_more_bad_arguments_are_refused_in_one_line(surefoot_here, write, arguments, fragments):
    assert_refused(surefoot_here("run", write(GOOD), *arguments), fragments)


def test_missing_file_is_refused_with_the_shipped_scenarios(surefoot, tmp_path):
    missing = tmp_path / "nothing.toml"
    assert_refused(surefoot("run", missing), [str(missing), "No such file", "stand_left", "stone_outer_edge"])


def test_a_file_that_is_no_text_is_refused(surefoot_here, write):
    assert_refused(
        surefoot_here("run", write(b"\xff\xfe\x00\x01")),
        ["is not UTF-8 text (UTF-16 with a byte-order mark?): save it as UTF-8"],
    )


def test_a_folder_as_output_is_refused_before_the_run(surefoot_here, tmp_path):
    (tmp_path / "result.json").mkdir()
    assert_refused(surefoot_here("run", "stand_left", "--out", tmp_path / "result.json"), ["--out", "is a folder"])


@pytest.mark.parametrize("command", [("plan", "swing_inward"), ("grid",)], ids=["plan", "grid"])
def test_an_output_that_cannot_be_a_file_is_refused_before_anything_is_computed(surefoot_here, tmp_path, command):
    (tmp_path / "result.csv").mkdir()
    assert_refused(surefoot_here(*command, "--out", tmp_path / "result.csv"), ["--out", "is a folder"])
    missing = tmp_path / "nowhere" / "result.csv"
    assert_refused(surefoot_here(*command, "--out", missing), ["--out", "folder does not exist"])


@pytest.mark.parametrize("command", ["grid", "figures", "ablate", "map"])
def test_less_than_one_process_is_refused(surefoot_here, tmp_path, command):
    refused = surefoot_here(command, "--out", tmp_path / "result", "--workers", 0)
    assert_refused(refused, ["--workers", "must be at least 1"])

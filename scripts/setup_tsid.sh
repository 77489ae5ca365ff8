#!/usr/bin/env bash
# Makes an environment of its own in which the contest's TSID adapter runs: Surefoot with its pinned dependencies, TSID
# built from source against that very Pinocchio (its binary wheel is made for another one), and the adapter.
#   ./scripts/setup_tsid.sh            into .venv-tsid in the repository's root
#   ./scripts/setup_tsid.sh FOLDER     into another folder
# Needs Python 3.11 or newer with venv, a C++ compiler and make, 3 GB of memory and 2 GB of disk; some ten to twenty
# minutes. PYTHON names another interpreter, CMEEL_JOBS how many compilers run at a time (2). What is done is not done
# again: interrupted, call it once more.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
venv="${1:-$root/.venv-tsid}"
version=1.10.0 # of tsid, and of the library below it
tools=("jrl-cmakemodules==2.1.0" "eiquadprog[build]==1.3.2" "cmake<5" "cmeel[build]" "pin[build]" scipy)

say() { printf 'surefoot: %s\n' "$*" >&2; }
die() { say "$@"; exit 1; }

recent() { "$1" -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; }

# Sets `base` to the first Python that is recent enough and can make a venv.
find_python() {
  for base in ${PYTHON:-python3.13 python3.12 python3.11 python3}; do
    if recent "$base"; then return; fi
  done
  die 'Python 3.11 or newer with its venv module is needed (Debian, Ubuntu: apt install python3 python3-venv)'
}

install() { "$venv/bin/python" -m pip install -qq --disable-pip-version-check "$@"; }

# build NAME MINUTES: compile one package beside the Pinocchio that is installed, unless that has been done. Nothing is
# taken from pip's cache, where a build against another Pinocchio may lie under the same name.
build() {
  local done_mark="$venv/.built-$1-$version-pin-$pin"
  [[ -e $done_mark ]] && return
  say "building $1 $version from source (some $2 minutes) ..."
  install --no-build-isolation --no-cache-dir --force-reinstall --no-deps --no-binary "$1" "$1==$version" ||
    die "$1 could not be built; the compiler's words stand above. Repair it and call this script again"
  : >"$done_mark"
}

{ command -v c++ || command -v g++ || command -v clang++; } >/dev/null ||
  die 'a C++ compiler is needed (Debian, Ubuntu: apt install g++ make)'
command -v make >/dev/null || die 'make is needed (Debian, Ubuntu: apt install make)'

if ! "$venv/bin/python" -m pip --version >/dev/null 2>&1; then
  [[ ! -e $venv ]] || die "$venv is there, but no environment that works: remove it, or name another folder"
  find_python
  say "making $venv ..."
  "$base" -m venv "$venv"
fi
venv="$(cd "$venv" && pwd -P)"
cd "$root"

say 'installing Surefoot and what the build needs (a few minutes) ...'
install -c constraints.txt -e . pytest "${tools[@]}"
pin="$("$venv/bin/python" -c 'from importlib.metadata import version; print(version("pin"))')"
CMAKE_PREFIX_PATH="$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')/cmeel.prefix"
export CMAKE_PREFIX_PATH PATH="$venv/bin:$PATH" CMEEL_JOBS="${CMEEL_JOBS:-2}"
build libtsid 6
build tsid 6
install --no-deps --force-reinstall ./tests/control/contest/tsid_controller

say 'checking ...'
"$venv/bin/python" -W ignore - <<'END' || die 'TSID is installed, but does not work with this Pinocchio'
import tsid

from surefoot.robot.description import load_robot

robot = load_robot("bip")
wrapper = tsid.RobotWrapper(robot.pinocchio_model, tsid.FLOATING_BASE_SYSTEM, False)
assert wrapper.na == len(robot.joints)
END
say "ready: $venv/bin/surefoot run stand_left --controller tsid"

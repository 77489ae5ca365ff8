#!/usr/bin/env bash
# Makes .venv in the repository's root and installs Surefoot with its pinned dependencies; returns at once when that
# has been done. Called by ./scripts/dashboard and ./scripts/test; there is no need to call it by hand.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
venv="$root/.venv"
python="$venv/bin/python"
stamp="$venv/.surefoot-installed"    # holds the fingerprint of what was installed, and where
pending="$venv/.surefoot-installing" # is there while an install runs: found at a start, it means "was interrupted"

say() { printf 'surefoot: %s\n' "$*" >&2; }
die() { say "$@"; exit 1; }

# Hash of all that decides what is in .venv, taken by its own Python: fails as well when that Python is gone.
fingerprint() {
  "$python" -ISc '
import hashlib, pathlib, sys
root = pathlib.Path(sys.argv[1])
text = b"\0".join((root / name).read_bytes() for name in ("pyproject.toml", "constraints.txt"))
print(hashlib.sha256(text + sys.version.encode()).hexdigest(), root)
' "$root" 2>/dev/null
}

up_to_date() { [[ -f $stamp && ! -e $pending ]] && [[ "$(fingerprint)" == "$(<"$stamp")" ]]; }

recent() { "$1" -ISc 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; }

# Can make a venv: uv brings all that it needs, otherwise Python's own venv with ensurepip (python3-venv on Debian).
makes_venv() { [[ -n $uv ]] || "$1" -ISc 'import ensurepip, venv' >/dev/null 2>&1; }

# Sets `base` to the first Python that is recent enough and can make a venv; `lame` to one that only lacks the latter.
find_python() {
  local name
  base='' lame=''
  for name in python3.13 python3.12 python3.11 python3; do
    recent "$name" || continue
    if makes_venv "$name"; then base="$name"; return 0; fi
    lame="${lame:-$name}"
  done
  return 1
}

require_python() {
  find_python && return
  if [[ $(id -u) == 0 ]] && command -v apt-get >/dev/null; then
    say 'installing python3-venv with apt-get ...'
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq python3-venv; } </dev/null >/dev/null 2>&1 || true
    hash -r
    find_python && return
  fi
  if [[ -n $lame ]]; then
    die "$lame cannot make virtual environments; install its venv module (Debian, Ubuntu: apt install python3-venv)"
  fi
  die 'Python 3.11 or newer is needed; install it (Debian, Ubuntu: apt install python3 python3-venv)'
}

# An environment can be built upon when no install was cut short in it, it was not copied from another place (its
# scripts would start that one), its Python runs and is recent, and there is something to install with.
usable() {
  [[ ! -e $pending ]] && [[ ! -f $stamp || "$(<"$stamp")" == *" $root" ]] && recent "$python" &&
    { [[ -n $uv ]] || "$python" -Im pip --version >/dev/null 2>&1; }
}

set_up() {
  if usable; then
    say 'installing packages into .venv ...'
  else
    require_python
    local why='first run'
    [[ -d $venv ]] && why='.venv cannot be used, starting afresh'
    say "$why: installing packages into .venv (a few minutes, 1.5 GB) ..."
    rm -rf "$venv"
    mkdir "$venv"
    : >"$pending"
    if [[ -n $uv ]]; then
      "$uv" venv --quiet --no-python-downloads --allow-existing --python "$(command -v "$base")" "$venv"
    else
      "$base" -m venv "$venv"
    fi
  fi
  : >"$pending"
  rm -f "$stamp"
  cd "$root"
  if [[ -n $uv ]]; then
    "$uv" pip install --quiet --python "$python" -c constraints.txt -e '.[dev]'
  else
    "$python" -m pip install -qq --disable-pip-version-check -c constraints.txt -e '.[dev]'
  fi
  fingerprint >"$stamp"
  rm -f "$pending"
  say 'ready.'
}

if ! up_to_date; then
  uv="$(command -v uv || true)"
  if command -v flock >/dev/null; then # of two first runs at a time the second waits
    exec 9<"$root"
    flock --nonblock 9 || { say 'waiting for another set-up to end ...'; flock 9; }
  fi
  up_to_date || set_up
fi

# Shared by `app/start` and `tests/run`: a virtual environment on a machine that may have nothing but a shell.

may_install() { command -v apt-get >/dev/null && { [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null; }; }

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi; }

# told WHAT COMMAND...: says what is done, runs the command, and every 5 s tells for how long and the last line of its
# output; all of the output if the command fails.
told() {
    local what=$1 begun=$SECONDS next=5 status=0 log work
    shift
    log=$(mktemp)
    echo "$what ..."
    "$@" >"$log" 2>&1 </dev/null &
    work=$!
    trap 'kill "$work" 2>/dev/null; rm -f "$log"; exit 130' INT TERM
    while kill -0 "$work" 2>/dev/null; do
        sleep 0.5
        if ((SECONDS - begun >= next)); then
            echo "  $((SECONDS - begun)) s: $(tail -n 1 "$log" | tr -d '\r' | cut -c 1-100)"
            next=$((SECONDS - begun + 5))
        fi
    done
    wait "$work" || status=$?
    trap - INT TERM
    if ((status)); then cat "$log" >&2; else echo "  done in $((SECONDS - begun)) s"; fi
    rm -f "$log"
    return "$status"
}

# install_packages NAME...: Debian packages, if this user may.
install_packages() { told "installing the Debian packages $*" install_quietly "$@"; }

install_quietly() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@" && return
    as_root apt-get update -q &&
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@"
}

# find_python: prints the name of a Python of 3.11 or newer; fails if there is none.
find_python() {
    local name
    for name in "${PYTHON:-python3}" python3 python3.13 python3.12 python3.11; do
        if "$name" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            echo "$name"
            return
        fi
    done
    return 1
}

# install_python: Debian's, where there is none that is new enough, or where it lacks what `venv` needs.
install_python() {
    if may_install && install_packages python3 python3-venv; then return; fi
    echo "please run:  sudo apt install python3 python3-venv   and try again" >&2
    return 1
}

# make_environment FOLDER: a virtual environment with pip.  Debian keeps what `venv` needs in a package of its own.
make_environment() {
    local python
    [ -x "$1/bin/python" ] && "$1/bin/python" -m pip --version >/dev/null 2>&1 && return
    python=$(find_python) || { echo "There is no Python of version 3.11 or newer here." && install_python; }
    python=$(find_python) || {
        echo "found no Python of version 3.11 or newer, and this system offers none" >&2
        return 1
    }
    if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
        echo "Python's venv is missing."
        install_python
    fi
    told "making a virtual environment in $1" "$python" -m venv "$1"
}

# install_with_pip FOLDER WHAT...: into that environment.
install_with_pip() {
    local folder=$1
    shift
    "$folder/bin/python" -m pip install --disable-pip-version-check --root-user-action=ignore --progress-bar off "$@"
}

# A stamp of everything that goes into the installed program.
sources_stamp() { find pyproject.toml README.md LICENSE app engine shaders palettes -type f ! -name '*.pyc' -print0 | sort -z | xargs -0 cksum | cksum; }
same_sources() { [ -f "$1" ] && [ "$(cat "$1")" = "$(sources_stamp)" ]; }
note_sources() { sources_stamp >"$1"; }

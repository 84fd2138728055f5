# Shared by `app/start` and `tests/run`: a virtual environment on a machine that may have nothing but Python.

may_install() { command -v apt-get >/dev/null && { [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null; }; }

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi; }

# install_packages NAME...: Debian packages, if this user may.
install_packages() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null 2>&1 && return
    as_root apt-get update -qq &&
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# find_python: prints the name of a Python of 3.11 or newer.
find_python() {
    local name
    for name in "${PYTHON:-python3}" python3 python3.13 python3.12 python3.11; do
        if "$name" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            echo "$name"
            return
        fi
    done
    echo "found no Python of version 3.11 or newer; on Debian: apt install python3 python3-venv" >&2
    return 1
}

# make_environment FOLDER: a virtual environment with pip.  Debian keeps what `venv` needs in a package of its own.
make_environment() {
    local python
    [ -x "$1/bin/python" ] && "$1/bin/python" -m pip --version >/dev/null 2>&1 && return
    python=$(find_python)
    if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
        echo "Python's venv is missing: installing the Debian package python3-venv ..."
        if ! may_install || ! install_packages python3-venv; then
            echo "please run:  sudo apt install python3-venv   and try again" >&2
            return 1
        fi
    fi
    "$python" -m venv "$1"
}

# A stamp of everything that goes into the installed program.
sources_stamp() { find pyproject.toml README.md LICENSE app engine shaders palettes -type f ! -name '*.pyc' -print0 | sort -z | xargs -0 cksum | cksum; }
same_sources() { [ -f "$1" ] && [ "$(cat "$1")" = "$(sources_stamp)" ]; }
note_sources() { sources_stamp >"$1"; }

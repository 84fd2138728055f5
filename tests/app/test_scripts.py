"""The one-line scripts: valid shell, and a plain word where a machine lacks what they need."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS = ["app/start", "tests/run", "app/environment.sh", ".ci/run"]


@pytest.mark.parametrize("name", SCRIPTS)
def test_valid_shell(name):
    subprocess.run(["bash", "-n", ROOT / name], check=True)


def test_the_readme_names_the_scripts():
    lines = (ROOT / "README.md").read_text().splitlines()
    assert "    bash app/start" in lines
    assert "    bash tests/run" in lines


def in_environment(line, tmp_path, **variables):
    command = f"set -euo pipefail; source {ROOT}/app/environment.sh; {line}"
    environment = {"PATH": os.environ["PATH"], "HOME": str(tmp_path), **variables}
    return subprocess.run(["bash", "-c", command], env=environment, cwd=tmp_path, capture_output=True, text=True)


def lent(tmp_path, **programs):
    """A folder of programs: those named here, and of the system's what the scripts themselves need."""
    (tmp_path / "bin").mkdir()
    for name in ("bash", "id", "mktemp", "cat", "rm", "sleep", "tail", "tr", "cut", "env"):
        (tmp_path / "bin" / name).symlink_to(shutil.which(name))
    for name, text in programs.items():
        path = tmp_path / "bin" / name.replace("_", "-")
        path.write_text(f"#!/bin/bash\n{text}\n")
        path.chmod(0o755)
    return {"PATH": str(tmp_path / "bin")}


def test_without_python_the_script_says_the_line_to_run(tmp_path):
    done = in_environment("make_environment there", tmp_path, **lent(tmp_path))
    assert done.returncode != 0
    assert "please run:  sudo apt install python3 python3-venv" in done.stderr
    assert not (tmp_path / "there").exists()


def test_a_python_without_venv_is_told_apart(tmp_path):
    """On Debian the package python3-venv is missing; here apt-get is not to be had either."""
    python = 'case "$*" in *ensurepip*) exit 1;; *) exit 0;; esac'
    done = in_environment("make_environment there", tmp_path, **lent(tmp_path, python3=python))
    assert done.returncode != 0
    assert "Python's venv is missing" in done.stdout
    assert "please run:  sudo apt install python3 python3-venv" in done.stderr


def test_python_is_installed_by_those_who_may(tmp_path):
    """An apt-get that brings a python3; it asks for the lists first, as on a machine that has none yet."""
    python = f'echo "$@" >> {tmp_path}/asked; case "$1" in -m) : > {tmp_path}/made;; esac'
    apt = f"""case "$*" in
        update*) : > {tmp_path}/lists;;
        *) [ -f {tmp_path}/lists ] || exit 100
           echo '{python}' > {tmp_path}/bin/python3; {shutil.which("chmod")} +x {tmp_path}/bin/python3;;
    esac"""
    path = lent(tmp_path, apt_get=apt, sudo='shift; exec "$@"')
    done = in_environment("make_environment there", tmp_path, **path)
    assert done.returncode == 0, done.stderr
    assert "installing the Debian packages python3 python3-venv ..." in done.stdout
    assert "making a virtual environment in there ..." in done.stdout
    assert (tmp_path / "asked").read_text().splitlines()[-1] == "-m venv there"


def test_long_work_tells_how_it_goes(tmp_path):
    clock = 'sleep() { until [ -s "$log" ]; do command sleep 0.02; done; SECONDS=$((begun + 5)); : > passed; }'
    work = 'bash -c "echo half; until [ -e passed ]; do sleep 0.02; done; echo end"'
    done = in_environment(f'{clock}; told "waiting" {work}', tmp_path)
    first, *others = done.stdout.splitlines()
    assert first == "waiting ..."
    assert re.fullmatch("  [0-9]+ s: (half|end)", others[0])
    assert others[-1].startswith("  done in ")


def test_failed_work_shows_all_that_it_said(tmp_path):
    done = in_environment('told "trying" bash -c "echo one; echo two >&2; exit 3" || exit $?', tmp_path)
    assert done.returncode == 3
    assert done.stdout == "trying ...\n"
    assert done.stderr == "one\ntwo\n"


def test_the_start_reads_no_file_of_the_tests():
    assert not [line for line in (ROOT / "app" / "start").read_text().splitlines() if "tests/" in line]
    assert "tests/" not in (ROOT / "app" / "environment.sh").read_text().partition("\n")[2]


def run_tests(tmp_path, *words, fails="never"):
    """What tests/run asks for, in order, in an environment whose python writes that down and fails when `fails` stands
    among its words."""
    (tmp_path / "venv" / "bin").mkdir(parents=True)
    (tmp_path / "venv" / ".pyproject").write_bytes((ROOT / "pyproject.toml").read_bytes())
    for name in ("python", "ruff", "mypy"):
        text = f'echo {name} "$*" >> {tmp_path}/asked; case " $* " in *" {fails} "*) exit 3;; esac'
        (tmp_path / "venv" / "bin" / name).write_text(f"#!/bin/bash\n{text}\n")
        (tmp_path / "venv" / "bin" / name).chmod(0o755)
    path = lent(tmp_path)
    for name in ("dirname", "cmp"):
        (tmp_path / "bin" / name).symlink_to(shutil.which(name))
    environment = {**path, "HOME": str(tmp_path), "INKFALL_TEST_VENV": str(tmp_path / "venv")}
    done = subprocess.run(["bash", ROOT / "tests" / "run", *words], env=environment, capture_output=True, text=True)
    asked = [line for line in (tmp_path / "asked").read_text().splitlines() if " -m pip " not in line]
    return done.returncode, asked


def test_all_tests_run_beside_one_another_and_a_failure_is_told(tmp_path):
    status, asked = run_tests(tmp_path, fails="-n")
    assert status == 3
    assert asked[-1] == "python -m pytest -n 2 --dist worksteal"
    assert "python -m app doctor --prepare" in asked[:-1]


def test_some_are_chosen_after_the_order_of_imports(tmp_path):
    status, asked = run_tests(tmp_path, "-k", "canvas")
    assert status == 0
    assert asked[-1].endswith(" -k canvas")
    assert "python -m pytest tests/test_architecture.py" in asked[:-1]


def test_no_test_runs_where_a_check_fails(tmp_path):
    status, asked = run_tests(tmp_path, fails="check")
    assert status == 3
    assert not [line for line in asked if "pytest" in line]


def test_checks_alone(tmp_path):
    status, asked = run_tests(tmp_path, "--checks")
    assert status == 0
    assert asked == [
        "ruff format --check .",
        "ruff check .",
        "mypy ",
        "python -m pytest tests/test_architecture.py tests/test_counts.py",
    ]


def test_benchmarks_of_some_names(tmp_path):
    status, asked = run_tests(tmp_path, "--bench", "dab", "view")
    assert status == 0
    assert asked == ["python -m app bench --compare tests/bench/ratios.json dab view"]

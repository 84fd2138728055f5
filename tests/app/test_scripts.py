"""The one-line scripts: valid shell, and a plain word where a machine lacks what they need."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS = ["app/start", "tests/run", "tests/environment.sh", ".ci/run"]


@pytest.mark.parametrize("name", SCRIPTS)
def test_valid_shell(name):
    subprocess.run(["bash", "-n", ROOT / name], check=True)


def test_the_readme_names_the_scripts():
    lines = (ROOT / "README.md").read_text().splitlines()
    assert "    bash app/start" in lines
    assert "    bash tests/run" in lines


def in_environment(line, tmp_path, **variables):
    command = f"set -euo pipefail; source {ROOT}/tests/environment.sh; {line}"
    environment = {"PATH": os.environ["PATH"], "HOME": str(tmp_path), **variables}
    return subprocess.run(["bash", "-c", command], env=environment, cwd=tmp_path, capture_output=True, text=True)


def test_without_python_the_script_says_what_to_install(tmp_path):
    (tmp_path / "bin").mkdir()
    for name in ("bash", "id"):
        (tmp_path / "bin" / name).symlink_to(Path("/bin") / name if name == "bash" else Path("/usr/bin") / name)
    done = in_environment("make_environment there", tmp_path, PATH=str(tmp_path / "bin"))
    assert done.returncode != 0
    assert "found no Python of version 3.11 or newer" in done.stderr
    assert not (tmp_path / "there").exists()


def test_a_python_without_venv_is_told_apart(tmp_path):
    """On Debian the package python3-venv is missing; here apt-get is not to be had either."""
    (tmp_path / "bin").mkdir()
    python = tmp_path / "bin" / "python3"
    python.write_text('#!/bin/bash\ncase "$*" in *ensurepip*) exit 1;; *) exit 0;; esac\n')
    python.chmod(0o755)
    for name, path in {"bash": "/bin/bash", "id": "/usr/bin/id"}.items():
        (tmp_path / "bin" / name).symlink_to(path)
    done = in_environment("make_environment there", tmp_path, PATH=str(tmp_path / "bin"))
    assert done.returncode != 0
    assert "sudo apt install python3-venv" in done.stderr

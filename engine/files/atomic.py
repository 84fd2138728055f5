"""Writing a file so that its place always holds the whole old one or the whole new one.

The bytes go to a fresh file beside it, are synced, checked, and renamed over it; then the folder is synced.  That
order leaves no state after a loss of power in which the place holds less than one good version.
"""

from __future__ import annotations

import errno
import os
import re
import secrets
import shutil
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from engine.files.fault import WriteError, reason_of

try:
    import fcntl
except ImportError:  # Windows: no advisory locks, so nothing is swept there
    fcntl = None  # type: ignore[assignment]

NAME_KEPT = 180  # bytes of the name that a temporary name repeats: it must stay below 255


@contextmanager
def replacing(path: str | os.PathLike[str], verify: Callable[[Path], None] | None = None) -> Iterator[BinaryIO]:
    """Hands out a new binary file (seekable, readable); when the block ends well, it takes the place of `path`.

    `verify` may read the finished temporary file and raise to refuse it.  A symbolic link is followed; the mode of
    a file that was there is kept.  Whatever is raised, the temporary file is gone and the old file untouched;
    an OSError comes out as WriteError.
    """
    try:
        target = Path(os.path.realpath(path))
        mode = _mode_of(target)
        sweep(target)
        descriptor, part = _create(target, mode)
    except (OSError, ValueError) as error:
        raise WriteError(path, f"cannot be written: {_reason(error)}") from error
    done = False
    try:
        with open(part, "w+b", opener=lambda path, flags: descriptor) as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        if verify is not None:
            verify(part)
        os.replace(part, target)
        done = True
        sync_folder(target.parent)
    except OSError as error:
        outcome = "was written, but may not survive a loss of power" if done else "cannot be written"
        raise WriteError(path, f"{outcome}: {_reason(error)}") from error
    finally:
        if not done:
            with suppress(OSError):
                part.unlink()


def part_folder(target: Path) -> Path:
    """Makes a folder beside `target` for what will take its place and others', and returns it; OSError on failure.
    What a killed process leaves of it is swept as `sweep` sweeps files, where the number of that process is told."""
    part = target.parent / f"{_stem(target)}.{os.getpid()}.{secrets.token_hex(4)}.part"
    part.mkdir(mode=0o700)
    return part


def sweep(target: Path, gone: int = 0) -> int:
    """Removes temporary files of `target` that a killed process left behind; gives their number.  `gone`: the number of
    a process that is known to be gone, whoever has that number now."""
    pattern = re.compile(re.escape(_stem(target)) + r"\.(\d+)\.[0-9a-f]{8}\.part")
    removed = 0
    try:
        names = os.listdir(target.parent)
    except OSError:
        return 0
    for name in names:
        found = pattern.fullmatch(name)
        if found and (int(found[1]) == gone or _abandoned(target.parent / name, int(found[1]))):
            with suppress(OSError):
                _remove(target.parent / name)
                removed += 1
    return removed


def _remove(part: Path) -> None:
    if part.is_dir() and not part.is_symlink():
        shutil.rmtree(part)
    else:
        part.unlink()


def _stem(target: Path) -> str:
    return "." + os.fsdecode(os.fsencode(target.name)[:NAME_KEPT])


def _mode_of(target: Path) -> int | None:
    """Permission bits of the file that is there; None if there is none.  Only regular files can be replaced."""
    try:
        status = target.stat()
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(status.st_mode):
        kind = "a folder" if stat.S_ISDIR(status.st_mode) else "not a regular file"
        raise OSError(errno.EISDIR, f"{kind}; expected a file name")
    if not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, "the file is read-only")
    return stat.S_IMODE(status.st_mode)


def _create(target: Path, mode: int | None) -> tuple[int, Path]:
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
    for _ in range(16):
        part = target.parent / f"{_stem(target)}.{os.getpid()}.{secrets.token_hex(4)}.part"
        try:
            descriptor = os.open(part, flags, 0o666)
        except FileExistsError:
            continue
        if fcntl is not None:
            with suppress(OSError):  # some network folders have no locks
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if mode is not None and hasattr(os, "fchmod"):
            with suppress(OSError):
                os.fchmod(descriptor, mode)
        return descriptor, part
    raise OSError(errno.EEXIST, "no free temporary name beside it")


def _abandoned(part: Path, pid: int) -> bool:
    """True if the process that made `part` is gone and nobody holds its lock."""
    if fcntl is None or pid == os.getpid():
        return False
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        pass
    except (OSError, OverflowError):
        return False
    else:
        return False
    try:
        descriptor = os.open(part, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0))
    except OSError:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    finally:
        os.close(descriptor)
    return True


def sync_folder(folder: Path) -> None:
    """Makes the rename durable; systems that cannot open or sync a folder do without."""
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:
        return
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.EBADF):
            raise
    finally:
        os.close(descriptor)


def _reason(error: Exception) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such folder"
    return reason_of(error)

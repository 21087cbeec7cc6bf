# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Finds the program and runs it beside an interface that must stay alive: with progress, cancelable, errors as sentences."""
import codecs
import json
import os
import re
import shutil
import subprocess
import tempfile
import threading
import typing

PROGRESS = re.compile(r"([^\r\n]+) \[[# ]*\] (\d+) of (\d+)")
CONTROL = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")


class MienError(Exception):
    """Something a user can put right; the text says what."""


class Progress(typing.NamedTuple):
    """What is going on, how much of it is done (0 to 1, None where that is not known), whether the scene must wait."""
    what: str
    share: typing.Optional[float] = None
    holds: bool = False


Steps = typing.Generator[Progress, None, typing.Any]


def find_program(wanted: str = "") -> str:
    """The program at the path that was set, or else the first `mien` on the PATH."""
    if wanted:
        path = os.path.abspath(os.path.expanduser(wanted))
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return path
        raise MienError(f"There is no program at {path}; correct the path to mien, or empty it to look along the PATH.")
    found = shutil.which("mien")
    if found:
        return found
    raise MienError("The program mien was not found on the PATH; set the path to it. Building mien makes it, "
                    "as build/release/mien.")


def _open_stderr() -> typing.Tuple[int, int]:
    """Where to read the program's errors and where it writes them: a terminal where there are such, since progress is
    shown on terminals only; else a pipe."""
    try:
        return os.openpty()
    except (AttributeError, OSError):
        return os.pipe()


class Run:
    """One run of the program. Its report goes to a file of ours; a thread collects its errors and its progress."""

    def __init__(self, program: str, arguments: typing.Sequence[str]):
        self.progress = Progress(f"mien {arguments[0]}")
        self._said = ""
        self._folder = tempfile.TemporaryDirectory(prefix="mien-")
        self._report = os.path.join(self._folder.name, "report.json")
        reading, writing = _open_stderr()
        flags = getattr(subprocess, "CREATE_NO_WINDOW", 0)
        try:
            self._process = subprocess.Popen([program, *arguments, "--report", self._report], stdin=subprocess.DEVNULL,
                                             stdout=subprocess.DEVNULL, stderr=writing, creationflags=flags)
        except OSError as error:
            os.close(reading)
            self._folder.cleanup()
            raise MienError(f"{program} cannot be run: {error.strerror or error}.") from error
        finally:
            os.close(writing)
        self._listener = threading.Thread(target=self._listen, args=(reading,), daemon=True)
        self._listener.start()

    def _listen(self, reading: int) -> None:
        decoder = codecs.getincrementaldecoder("utf-8")("replace")
        while True:
            try:
                piece = os.read(reading, 4096)
            except OSError:  # how a terminal says that its other side was closed
                piece = b""
            if not piece:
                break
            self._said = (self._said + decoder.decode(piece))[-20000:]
            told = PROGRESS.findall(CONTROL.sub("", self._said))
            if told:
                what, done, whole = told[-1]
                self.progress = Progress(what.strip(), int(done) / max(int(whole), 1))
        os.close(reading)

    def wait(self, seconds: float) -> bool:
        """Whether the program has ended, within this time."""
        try:
            self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return False
        return True

    def finish(self) -> dict:
        """The report of a run that has ended well; else raises what the program said."""
        self._listener.join()
        if self._process.returncode != 0:
            raise MienError(self._sentence())
        with open(self._report, encoding="utf-8") as file:
            return json.load(file)

    def _sentence(self) -> str:
        text = PROGRESS.sub("", CONTROL.sub("", self._said))
        lines = [line.strip() for line in re.split(r"[\r\n]+", text) if line.strip()]
        said = " ".join(lines)
        if said:
            return said[len("mien: "):] if said.startswith("mien: ") else said
        return f"mien ended with status {self._process.returncode} and said nothing."

    def stop(self) -> None:
        """Ends the program if it still runs, and lets go of what was opened for it."""
        if self._process.poll() is None:
            self._process.terminate()
            if not self.wait(2):
                self._process.kill()
                self._process.wait()
        self._listener.join()
        self._folder.cleanup()


def running(program: str, arguments: typing.Sequence[str]) -> Steps:
    """Runs the program step by step; the generator's value is its report. Closing it ends the program."""
    run = Run(program, arguments)
    try:
        while not run.wait(0.02):
            yield run.progress
        return run.finish()
    finally:
        run.stop()

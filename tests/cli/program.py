# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Calling the program from a test: where it is, the sample it works on, and heads and takes beside the project."""
import array
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

MIEN = pathlib.Path(os.environ["MIEN"]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "samples"
SHARED = ROOT.parent / "shared" / "data"

HEAD = SAMPLES / "head.glb"
POINTS = SAMPLES / "head.points.json"
TAKE = SAMPLES / "take.trc"
MAP = SAMPLES / "markers.csv"


def run(*arguments, cwd=None, **environment):
    """Runs mien; gives back what subprocess gives, with text in stdout and stderr."""
    return subprocess.run([MIEN, *map(str, arguments)], cwd=cwd, env={**os.environ, **environment},
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)


def some_rows(trc, rows):
    """The text of a TRC file with only some of its rows, from its first to its last."""
    lines = trc.read_text(encoding="utf-8").splitlines()
    first = next(i for i, line in enumerate(lines) if line.split("\t")[0].strip().isdigit() and i > 2)
    all_rows = len(lines) - first
    kept = lines[:first] + [lines[first + row * (all_rows - 1) // (rows - 1)] for row in range(rows)]
    names, values = kept[1].split("\t"), kept[2].split("\t")
    for i, name in enumerate(names):
        if name in ("NumFrames", "OrigNumFrames"):
            values[i] = str(rows)
    kept[2] = "\t".join(values)
    return "\n".join(kept) + "\n"


def fap_text(frames, rate=25):
    """A FAP text file that sends {fap: value} in every frame; FAPs 3 and up."""
    lines = [f"2.1 test {rate} {len(frames)}"]
    for number, values in enumerate(frames):
        lines.append(" ".join("1" if fap in values else "0" for fap in range(1, 69)))
        lines.append(" ".join(map(str, [number, *(values[fap] for fap in sorted(values))])))
    return "\n".join(lines) + "\n"


def read_mdd(path):
    """Times and rows of a point cache; x, y, z of its vertices one after another."""
    data = path.read_bytes()
    rows, vertices = struct.unpack(">ii", data[:8])
    values = array.array("f", data[8:])
    values.byteswap()
    return values[:rows], [values[rows + 3 * vertices * row:][:3 * vertices] for row in range(rows)]


class ProgramTest(unittest.TestCase):
    """Has a folder `work` for the class with a short take in it, `rows` long, and one `out` for each test."""
    rows = 24

    @classmethod
    def setUpClass(cls):
        cls.work = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.work)
        cls.take = cls.work / "short.trc"
        cls.take.write_text(some_rows(TAKE, cls.rows), encoding="utf-8")

    def setUp(self):
        self.out = self.work / self.id().rsplit(".", 1)[-1]
        self.out.mkdir()

    def refuses(self, status, words, *arguments):
        """A call fails with this status and these words, and leaves nothing behind."""
        result = run(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(list(self.out.iterdir()), [])

    def report(self, *arguments):
        """What a call that must succeed reports."""
        result = run(*arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

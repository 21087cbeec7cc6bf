# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What mien_calling promises to its hosts. usage: MIEN=build/release/mien calling_test.py"""
import array
import os
import pathlib
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("python", "tests/cli")]
from mien_calling import files, tasks
from mien_calling.program import MienError, find_program, running
from program import HEAD, MIEN

# Shows a progress line as mien does on a terminal, then waits for ever.
ENDLESS = r"""#!/bin/sh
[ -t 2 ] && printf '\r\033[Kbending [###       ] 3 of 10' >&2
exec sleep 600
"""


def end_of(steps):
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


class Calling(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)

    def script(self, text):
        path = self.out / "mien"
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)
        return str(path)

    def test_a_run_gives_the_report(self):
        report = end_of(running(str(MIEN), ["inspect", str(HEAD)]))
        self.assertEqual(report["kind"], "mesh")

    def test_an_error_is_the_sentence_of_the_program(self):
        with self.assertRaises(MienError) as caught:
            end_of(running(str(MIEN), ["inspect", "nowhere.obj"]))
        self.assertEqual(str(caught.exception), "nowhere.obj: cannot read: No such file or directory")
        with self.assertRaisesRegex(MienError, "ended with status 7 and said nothing"):
            end_of(running(self.script("#!/bin/sh\nexit 7\n"), ["rig"]))

    def test_progress_is_told_and_closing_ends_the_program(self):
        steps = running(self.script(ENDLESS), ["rig"])
        end = time.monotonic() + 20
        step = next(steps)
        while step.share is None and time.monotonic() < end:
            step = next(steps)
        self.assertEqual((step.what, step.share), ("bending", 0.3))
        before = time.monotonic()
        steps.close()
        self.assertLess(time.monotonic() - before, 10)

    def test_a_program_that_is_not_there_is_told(self):
        with self.assertRaisesRegex(MienError, "There is no program at .*nothing; correct the path"):
            find_program(str(self.out / "nothing"))
        path, os.environ["PATH"] = os.environ["PATH"], str(self.out)
        try:
            with self.assertRaisesRegex(MienError, "not found on the PATH; set the path"):
                find_program()
            self.assertEqual(find_program(self.script(ENDLESS)), find_program())
        finally:
            os.environ["PATH"] = path
        with self.assertRaisesRegex(MienError, "cannot be run"):
            end_of(running(self.script("\0 no program"), ["rig"]))

    def test_a_point_cache_comes_back_and_uneven_rows_are_played_evenly(self):
        path, times = str(self.out / "x.mdd"), [0, 1, 2, 3.5, 4]
        with files.MddWriter(path, times, 2) as writer:
            for second in times:  # a point that moves steadily, and one that rests
                writer.row(array.array("f", [second, 0, 0, 7, 8, 9]))
        with files.MddReader(path) as reader:
            self.assertEqual((reader.rows, reader.vertices, reader.rows_per_second()), (5, 2, 1))
            self.assertEqual(list(reader.row(3)), [3.5, 0, 0, 7, 8, 9])
            for row in range(5):
                self.assertEqual(list(reader.even_row(row)), [row, 0, 0, 7, 8, 9])
        whole = pathlib.Path(path).read_bytes()
        pathlib.Path(path).write_bytes(whole[:-1])
        with self.assertRaisesRegex(MienError, "this point cache is cut"):
            files.MddReader(path)

    def test_a_row_of_another_length_is_refused(self):
        with files.MddWriter(str(self.out / "x.mdd"), [0], 2) as writer:
            with self.assertRaisesRegex(MienError, "expected 2 vertices in every frame, found 1"):
                writer.row(array.array("f", [1, 2, 3]))

    def test_names_of_heads_are_names_of_files(self):
        self.assertEqual([tasks.clean(name) for name in ("Kate.001", "a/b: c", "..", "Zoë")], ["Kate.001", "a_b__c", "_", "Zoë"])


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What `mien render` and `mien rig --picture` promise, seen from outside: sizes, the same bytes twice, nothing left behind.

usage: MIEN=build/release/mien render_test.py
"""
import pathlib
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

from program import HEAD, MAP, MIEN, POINTS, SAMPLES, TAKE, run, some_rows

DRAFT = ("--quality", "draft", "--software")


def pixels(png):
    """Width, height and the rows of an opaque 8-bit RGB picture, filters undone."""
    data = png.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    place, packed = 8, b""
    while place < len(data):
        size, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 2), (depth, colour)
        if kind == b"IDAT":
            packed += body
        place += 12 + size
    raw, rows, above = zlib.decompress(packed), [], bytearray(3 * width)
    for y in range(height):
        start = y * (3 * width + 1)
        row = bytearray(raw[start + 1:start + 1 + 3 * width])
        undo(raw[start], row, above)
        rows.append(row)
        above = row
    return width, height, rows


def undo(kind, row, above):
    for x in range(len(row)):
        left = row[x - 3] if x >= 3 else 0
        corner = above[x - 3] if x >= 3 else 0
        guess = left + above[x] - corner
        nearest = min((left, above[x], corner), key=lambda value: abs(guess - value))
        row[x] = (row[x] + (0, left, above[x], (left + above[x]) // 2, nearest)[kind]) & 255


THUMBNAILS = pathlib.Path(__file__).with_name("thumbnails")


def largest_block_difference(one, other, block=8):
    """Of the mean colours of blocks of pixels, which edges that fall otherwise do not change much."""
    width, height, a = pixels(one)
    assert pixels(other)[:2] == (width, height), "pictures of one size"
    b, worst = pixels(other)[2], 0
    for top in range(0, height - block + 1, block):
        for left in range(0, width - block + 1, block):
            for channel in range(3):
                cells = [(y, 3 * x + channel) for y in range(top, top + block) for x in range(left, left + block)]
                worst = max(worst, abs(sum(a[y][x] - b[y][x] for y, x in cells)) / len(cells))
    return worst


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.work.name)
        take = cls.folder / "short.trc"
        take.write_text(some_rows(TAKE, 12), encoding="utf-8")
        cls.glb, cls.rig, cls.onto = cls.folder / "short.glb", cls.folder / "rig.glb", cls.folder / "onto.csv"
        cls.made(cls, "animate", HEAD, "--points", POINTS, "--take", take, "--map", MAP, "-o", cls.glb)
        cls.made(cls, "rig", HEAD, "--points", POINTS, "-o", cls.rig)
        cls.made(cls, "retarget", take, "--rig", cls.rig, "--map", MAP, "-o", cls.onto)

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    def made(self, *arguments):
        done = run(*arguments)
        assert done.returncode == 0, done.stderr
        return done

    def drawn(self, name, *arguments):
        path = self.folder / name
        self.made("render", *arguments, *DRAFT, "-f", "-o", path)
        return path

    def test_a_picture_has_the_size_asked_for_and_the_same_bytes_twice(self):
        one = self.drawn("one.png", self.glb, "--size", "120x90", "--time", "4")
        two = self.drawn("two.png", self.glb, "--size", "120x90", "--time", "4")
        self.assertEqual(one.read_bytes(), two.read_bytes())
        self.assertEqual(pixels(one)[:2], (120, 90))

    def test_full_quality_gives_the_same_bytes_twice(self):
        def once(name):
            path = self.folder / name
            self.made("render", HEAD, "--size", "64x64", "--passes", "8", "--software", "-o", path)
            return path.read_bytes()
        self.assertEqual(once("full-a.png"), once("full-b.png"))

    def test_time_moves_the_face(self):
        rest = pixels(self.drawn("rest.png", self.glb, "--size", "120x160"))[2]
        open_ = pixels(self.drawn("open.png", self.glb, "--size", "120x160", "--time", "4.4"))[2]
        self.assertNotEqual(rest, open_)

    def test_exact_rig_and_written_joints_look_alike(self):
        exact = pixels(self.drawn("exact.png", self.rig, "--take", self.onto, "--size", "120x160", "--time", "4.4"))[2]
        joints = pixels(self.drawn("joints.png", self.glb, "--size", "120x160", "--time", "4.4"))[2]
        differing = sum(abs(a - b) > 40 for x, y in zip(exact, joints) for a, b in zip(x, y))
        self.assertLess(differing, 0.03 * 3 * 120 * 160)

    def test_sample_heads_look_as_they_did(self):
        """Pictures stored as `mien render` drew them; other drivers may differ by a few of 255 steps."""
        for name, arguments in (("head-front", (HEAD, "--passes", "16")),
                                ("head-open", (self.glb, "--time", "4.4", "--close-up", "mouth", "--passes", "16")),
                                ("man-three-quarter", (SAMPLES / "man.glb", "--view", "three-quarter", "--passes", "16")),
                                ("cartoon-side", (SAMPLES / "cartoon.glb", "--view", "side", "--quality", "draft"))):
            path = self.folder / f"{name}.png"
            self.made("render", *arguments, "--software", "--size", "96x120", "-f", "-o", path)
            self.assertLess(largest_block_difference(path, THUMBNAILS / f"{name}.png"), 12, name)

    def test_a_folder_holds_a_frame_per_step(self):
        folder = self.drawn("frames", self.glb, "--size", "32x32", "--fps", "1")
        self.assertEqual(sorted(path.name for path in folder.iterdir()),
                         [f"frame_{i:06}.png" for i in range(1, 9)])

    def test_videos_are_what_their_names_say(self):
        mp4 = self.drawn("short.mp4", self.glb, "--size", "64x64", "--fps", "2").read_bytes()
        self.assertEqual(mp4[4:8], b"ftyp")
        webm = self.drawn("short.webm", self.glb, "--size", "64x64", "--fps", "2").read_bytes()
        self.assertEqual(webm[:4], b"\x1a\x45\xdf\xa3")

    def test_sheets_comparisons_takes_and_rig_pictures_are_drawn(self):
        for name, arguments in (("sheet.png", (self.glb, "--sheet", "--pictures", "3", "--size", "60x80")),
                                ("grid.png", (self.glb, "--compare", HEAD, "--sheet", "--pictures", "2", "--size", "60x80")),
                                ("take.png", (TAKE, "--size", "60x80", "--points")),
                                ("weights.png", (self.rig, "--weights", "8.4", "--size", "60x80")),
                                ("error.png", (self.glb, "--error", self.glb, "--size", "60x80"))):
            width, height, _ = pixels(self.drawn(name, *arguments))
            self.assertGreater(width * height, 60 * 80 - 1, name)

    def test_an_animation_beside_itself_has_no_error_and_beside_its_rest_has(self):
        def brightness(name, *arguments):
            rows = pixels(self.drawn(name, self.glb, "--time", "4.4", "--size", "120x160", *arguments))[2]
            return sum(sum(row) for row in rows[:160])
        itself = brightness("same.png", "--error", self.glb)
        self.assertGreater(brightness("other.png", "--error", HEAD), itself)

    def test_refusals_say_why_and_leave_nothing(self):
        empty = self.folder / "empty.glb"
        empty.write_bytes(b"glTF")
        before = sorted(self.folder.iterdir())
        for arguments, words in (((self.folder / "nobody.glb",), "nobody.glb"),
                                 ((empty,), "empty.glb"),
                                 ((HEAD, "--weights", "8.4"), "rig file"),
                                 ((self.rig, "--weights", "99.9"), "99.9"),
                                 ((HEAD, "--close-up", "8.4"), "8.4"),
                                 ((HEAD, "--take", self.onto), "rig file"),
                                 ((HEAD, "--size", "640"), "640x480")):
            done = run("render", *arguments, "-o", self.folder / "refused.png")
            self.assertIn(done.returncode, (1, 3), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(run("render", HEAD, "-o", self.folder / "refused.txt").returncode, 2)
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_an_interrupt_leaves_no_half_file(self):
        before = sorted(self.folder.iterdir())
        for name in ("long.mp4", "long-frames"):
            with subprocess.Popen([MIEN, "render", self.glb, "--fps", "1000", *DRAFT, "-o", self.folder / name],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as program:
                deadline = time.monotonic() + 60
                while sorted(self.folder.iterdir()) == before and time.monotonic() < deadline:
                    time.sleep(0.05)
                program.send_signal(signal.SIGINT)
                _, said = program.communicate(timeout=60)
            self.assertEqual(program.returncode, 130, said)
            self.assertIn("stopped", said)
            self.assertEqual(sorted(self.folder.iterdir()), before)


if __name__ == "__main__":
    unittest.main()

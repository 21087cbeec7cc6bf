# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What the verbs of MPEG-4 face animation promise. usage: MIEN=build/release/mien fap_test.py"""
import json
import re
import unittest

import program
from program import HEAD, MAP, POINTS, SHARED, TAKE, fap_text, run

FILTERS = ("mirror", "retime", "scale", "join", "blend", "statistics")


def read(path):
    """Frame number -> {fap: value} of a text file."""
    lines = path.read_text(encoding="utf-8").splitlines()[1:]
    frames = {}
    for mask, values in zip(lines[0::2], lines[1::2]):
        number, *numbers = map(int, values.split())
        sent = [i for i, bit in enumerate(mask.split(), 1) if bit == "1"]
        frames[number] = dict(zip(sent, numbers))
    return frames


class FaceAnimation(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.rig = cls.work / "rig.glb"
        assert run("rig", HEAD, "--points", POINTS, "-o", cls.rig).returncode == 0
        cls.smile = cls.work / "smile.fap"
        cls.smile.write_text(fap_text([{53: 10 * i, 3: 5 * i} for i in range(20)]), encoding="utf-8")

    def test_markers_become_parameters_in_the_performers_own_units(self):
        report = self.report("faps", self.take, "--points", MAP, "-o", self.out / "a.fap")
        self.assertEqual(report["faps"]["frames"], 24)
        self.assertGreater(report["units"]["mw"], 0)
        frames = read(self.out / "a.fap")
        self.assertEqual(len(frames), 24)
        self.assertEqual({value for fap, value in frames[0].items() if fap not in (48, 49, 50)}, {0})
        self.assertTrue(any(abs(value) > 50 for frame in frames.values() for value in frame.values()))
        self.report("faps", self.take, "--map", MAP, "-o", self.out / "b.fap")
        self.assertEqual((self.out / "a.fap").read_bytes(), (self.out / "b.fap").read_bytes())

    def test_a_stream_comes_back_as_it_was_coded(self):
        report = self.report("encode", self.smile, "-o", self.out / "s.fba", "--quant", 0)
        self.assertEqual(report["bitstream"]["values_clamped"], 0)
        self.report("decode", self.out / "s.fba", "-o", self.out / "s.fap")
        self.assertEqual(read(self.out / "s.fap"), read(self.smile))

    def test_a_bit_rate_is_kept_to(self):
        busy = self.work / "busy.fap"
        busy.write_text(fap_text([{fap: 37 * i * fap % 401 for fap in range(51, 61)} for i in range(60)]), encoding="utf-8")
        fine = self.report("encode", busy, "-o", self.out / "a.fba")["bitstream"]
        asked = 0.8 * fine["kilobits_per_second"]
        coarse = self.report("encode", busy, "-o", self.out / "b.fba", "--bitrate", asked)["bitstream"]
        self.assertLessEqual(coarse["kilobits_per_second"], asked)
        self.assertGreater(coarse["quantiser"], fine["quantiser"])

    def test_a_cut_stream_gives_its_whole_frames_and_a_warning(self):
        self.report("encode", self.smile, "-o", self.out / "s.fba")
        cut = self.out / "cut.fba"
        cut.write_bytes((self.out / "s.fba").read_bytes()[:-9])
        report = self.report("decode", cut, "-o", self.out / "c.fap")
        self.assertIn("cut", report["warnings"][0])
        self.assertTrue(0 < len(read(self.out / "c.fap")) < 20)

    def test_a_rigged_face_plays_text_and_stream_alike(self):
        self.report("encode", self.smile, "-o", self.out / "s.fba", "--quant", 0)
        for name in ("smile.fap", "s.fba"):
            source = self.smile if name == "smile.fap" else self.out / name
            report = self.report("play", self.rig, source, "-o", self.out / f"{name}.mdd")
            self.assertEqual(report["wrote"]["rows"], 20)
        self.assertEqual((self.out / "smile.fap.mdd").read_bytes(), (self.out / "s.fba.mdd").read_bytes())
        self.report("play", self.rig, self.smile, "-o", self.out / "p.glb")

    def test_a_table_says_what_the_stream_leaves_out(self):
        def played(name, stream, *arguments):
            report = self.report("play", self.rig, stream, *arguments, "-o", self.out / f"{name}.mdd")
            return report, (self.out / f"{name}.mdd").read_bytes()
        jaw, both = self.work / "jaw.fap", self.work / "both.fap"
        jaw.write_text(fap_text([{3: 10 * i} for i in range(9)]), encoding="utf-8")
        both.write_text(fap_text([{3: 10 * i, 5: -5 * i} for i in range(9)]), encoding="utf-8")
        table = self.work / "table.json"
        link = {"from": [3], "to": [{"fap": 5, "numerator": [{"coefficient": -0.5, "exponents": [1]}]}]}
        table.write_text(json.dumps({"links": [link]}), encoding="utf-8")
        report, by_table = played("a", jaw, "--fit", table)
        self.assertEqual(report["fit"], {"file": "table.json", "links": 1, "parameters": [5]})
        self.assertEqual(by_table, played("b", both)[1])
        self.assertNotEqual(by_table, played("c", jaw)[1])
        for name in ("a", "b", "c"):
            (self.out / f"{name}.mdd").unlink()
        link["to"][0]["fap"] = 69
        table.write_text(json.dumps({"links": [link]}), encoding="utf-8")
        self.refuses(1, ["table.json", "/links/0/to/0/fap"], "play", self.rig, jaw, "--fit", table, "-o", self.out / "d.mdd")

    def test_what_no_parameter_moves_is_refused(self):
        nothing = self.work / "nothing.fap"
        nothing.write_text("2.1 a 25 1\n" + " ".join(["0"] * 67 + ["x"]) + "\n0\n", encoding="utf-8")
        self.refuses(1, ["nothing.fap", "line 2"], "play", self.rig, nothing, "-o", self.out / "p.glb")
        bare = self.work / "bare.csv"
        bare.write_text("time,dimple.x,dimple.y,dimple.z,a.x,a.y,a.z\n0,1,2,3,4,5,6\n1,1,2,3,4,5,7\n", encoding="utf-8")
        self.refuses(1, ["bare.csv", "--map"], "faps", bare, "--head", "keep", "-o", self.out / "p.fap")
        self.refuses(2, [".fap"], "encode", self.smile, "-o", self.out / "p.mp4")

    def test_filters_do_what_they_say(self):
        def filtered(verb, *arguments):
            self.report("fap", verb, *arguments, "-f", "-o", self.out / "r.fap")
            return read(self.out / "r.fap")
        plain = read(self.smile)
        mirrored = filtered("mirror", self.smile)
        self.assertEqual(mirrored[4], {54: 40, 3: 20})
        self.assertEqual(len(filtered("retime", self.smile, "--speed", 2)), 10)
        self.assertEqual(len(filtered("retime", self.smile, "--rate", 50)), 39)
        scaled = filtered("scale", self.smile, "--strength", "mouth=0.5,open_jaw=2")
        self.assertEqual(scaled[4], {53: 20, 3: 40})
        self.assertEqual(len(filtered("join", self.smile, self.smile, self.smile)), 60)
        other = self.work / "other.fap"
        other.write_text(fap_text([{31: 100}] * 20), encoding="utf-8")
        self.assertEqual(filtered("blend", self.smile, other, "--share", 0.25)[4][31], 25)
        rows = {row["fap"]: row for row in self.report("fap", "statistics", self.smile)["statistics"]}
        self.assertEqual((rows[53]["low"], rows[53]["high"]), (0, max(frame[53] for frame in plain.values())))

    def test_a_part_that_is_none_is_refused(self):
        self.refuses(1, ["knee", "mouth"], "fap", "scale", self.smile, "--strength", "knee=2", "-o", self.out / "r.fap")

    def test_inspect_says_what_is_in_a_stream(self):
        self.assertEqual(self.report("inspect", self.smile)["faps"]["parameters"], 2)

    def test_the_help_of_every_filter_has_an_example_with_its_own_flags(self):
        for verb in FILTERS:
            result = run("fap", verb, "--help")
            self.assertEqual(result.returncode, 0)
            example = re.search(rf"^  (mien fap {verb} .*)$", result.stdout, re.MULTILINE)
            self.assertIsNotNone(example, verb)
            for flag in re.findall(r"--[a-z-]+", example.group(1)):
                self.assertIn(flag, result.stdout[:example.start()])

    def test_a_head_is_reshaped_to_measured_points_and_keeps_its_rig(self):
        report = self.report("morph", HEAD, "--points", POINTS, "--to", POINTS, "--to-head", HEAD, "-o", self.out / "m.glb")
        self.assertEqual(report["morph"]["points_carried_by_the_skin"], [])
        self.assertEqual((self.out / "m.glb").read_bytes(), self.rig.read_bytes())  # to its own points: nothing changes
        front, side = self.work / "front.json", self.work / "side.json"
        front.write_text('{"3.7": [50, 10, null], "3.8": [-50, 10, null], "2.1": [0, -120, null]}', encoding="utf-8")
        side.write_text('{"3.7": [null, 10, 5], "2.1": [null, -120, 0], "3.8": [null, 10, 5]}', encoding="utf-8")
        report = self.report("morph", self.rig, "--to", front, "--to", side, "-o", self.out / "n.glb")
        self.assertEqual(report["morph"]["points_met"], 3)
        self.report("play", self.out / "n.glb", self.smile, "-o", self.out / "p.mdd")
        front.write_text('{"3.7": 4}', encoding="utf-8")
        self.assertIn("front.json", run("morph", self.rig, "--to", front, "-o", self.out / "q.glb").stderr)

    @unittest.skipUnless(SHARED.is_dir(), "no data beside the project")
    def test_every_real_stream_plays_on_the_sample_head(self):
        for path in sorted((SHARED.parent / "mpeg4" / "samples").rglob("*.fap")):
            report = self.report("play", self.rig, path, "-f", "-o", self.out / "p.mdd")
            self.assertGreater(report["wrote"]["rows"], 0, path)

    @unittest.skipUnless(SHARED.is_dir(), "no data beside the project")
    def test_a_take_may_be_a_c3d_file(self):
        sample = SHARED / "malformed" / "mocap" / "c3d" / "sample02_pc_int.c3d"
        self.assertEqual(self.report("inspect", sample)["rows"], 89)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What the command line promises. usage: MIEN=build/release/mien cli_test.py"""
import array
import json
import math
import re
import shutil
import struct
import unittest

import program
from program import HEAD, MAP, POINTS, SHARED, TAKE, run

ROWS = 24
VERBS = ("animate", "inspect", "points", "rig", "retarget", "deform", "faps", "play", "encode", "decode", "morph",
         "fat")


class CommandLine(program.ProgramTest):
    rows = ROWS

    def animate(self, output, *flags, **environment):
        return run("animate", HEAD, "--points", POINTS, "--take", self.take, "--map", MAP, "-o", output, *flags,
                   **environment)

    def done(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, result, status, *words):
        """A failure: its status, one line on stderr with these words, nothing on stdout, nothing left behind."""
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual(result.stdout, "")
        for word in words:
            self.assertIn(str(word), result.stderr)
        self.assertEqual(list(self.out.iterdir()), [])

    # What goes wrong.

    def test_bad_input_exits_with_1_and_names_file_and_place(self):
        points = self.work / "bad.points.json"
        points.write_text('{"8.4": 0, "2.1": 99999999}', encoding="utf-8")
        self.refused(run("rig", HEAD, "--points", points, "-o", self.out / "r.glb"), 1, "bad.points.json", "2.1")
        take = self.work / "bad.csv"
        take.write_text("time,8.4.x,8.4.y,8.4.z\n0,1,2,3\n0.1,1,oops,3\n", encoding="utf-8")
        self.refused(run("animate", HEAD, "--points", POINTS, "--take", take, "-o", self.out / "a.glb"), 1, "bad.csv",
                     "line 3", "oops")

    def test_bad_usage_exits_with_2(self):
        for arguments in ([], ["dance"], ["animate", HEAD], ["inspect", HEAD, "--no-such-flag"],
                          ["rig", HEAD, "--points", POINTS, "--method", "magic", "-o", self.out / "r.glb"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertTrue(result.stderr.strip(), arguments)
            self.assertEqual(list(self.out.iterdir()), [])

    def test_an_output_of_unknown_kind_is_bad_usage(self):
        self.refused(self.animate(self.out / "a.fbx"), 2, "a.fbx")

    def test_what_cannot_be_read_or_written_exits_with_3(self):
        self.refused(run("inspect", self.out / "none.glb"), 3, "none.glb")
        folder = self.work / "folder.glb"
        folder.mkdir()
        self.refused(run("inspect", folder), 3, "folder.glb")
        self.refused(self.animate(self.out / "no" / "such" / "folder" / "a.glb"), 3, "folder")

    def test_a_gate_that_is_not_met_exits_with_4_and_writes_nothing(self):
        self.refused(self.animate(self.out / "a.glb", "--max-error", "1e-12"), 4, "--max-error")

    def test_an_output_that_is_there_is_kept_unless_forced(self):
        for name in ("a.glb", "a.mdd", "a.pc2"):
            output = self.out / name
            output.write_bytes(b"precious")
            result = self.animate(output)
            self.assertEqual(result.returncode, 3, result.stderr)
            self.assertIn("-f", result.stderr)
            self.assertEqual(output.read_bytes(), b"precious")
            self.done(self.animate(output, "-f"))
            self.assertNotEqual(output.read_bytes(), b"precious")
        self.assertEqual(len(list(self.out.iterdir())), 3)

    def test_an_output_that_is_an_input_is_refused_even_when_forced(self):
        for source, flags in ((HEAD, ()), (POINTS, ()), (self.take, ())):
            copy = self.out / source.name
            shutil.copy(source, copy)
            before = copy.read_bytes()
            inputs = {HEAD: HEAD, POINTS: POINTS, self.take: self.take, source: copy}
            link = self.out / "link.glb"
            link.symlink_to(copy)
            for output in (link, *([copy] if copy.suffix == ".glb" else [])):
                result = run("animate", inputs[HEAD], "--points", inputs[POINTS], "--take", inputs[self.take], "--map",
                             MAP, "-o", output, "-f", *flags)
                self.assertNotEqual(result.returncode, 0, f"{output} overwrote {source}")
                self.assertIn("input", result.stderr)
                self.assertEqual(copy.read_bytes(), before)
            link.unlink()

    def test_parts_that_are_none_and_takes_without_their_parts_are_refused(self):
        self.refused(self.animate(self.out / "a.glb", "--only", "mouht"), 1, "mouht", "mouth, jaw, brows")
        self.refused(self.animate(self.out / "a.glb", "--strength", "mouth"), 2, "mouth=1.2")
        self.refused(self.animate(self.out / "a.glb", "--take", self.take, "--only", "mouth"), 2, "--only")
        self.refused(self.animate(self.out / "a.glb", "--sealed", "4.1=0"), 1, "4.1", "pair")

    # What goes right.

    def moving(self, *flags):
        """The points that a retarget moves by more than a hundredth of a millimetre, and how far."""
        rig, onto = self.out / "r.glb", self.out / "onto.csv"
        self.done(run("rig", HEAD, "--points", POINTS, "-o", rig, "-f"))
        self.done(run("retarget", *flags, "--rig", rig, "--map", MAP, "--driven-only", "-o", onto, "-f"))
        names, *rows = [line.split(",") for line in onto.read_text(encoding="utf-8").splitlines()]
        far = {}
        for column in [i for i, name in enumerate(names) if re.fullmatch(r"\d+\.\d+\.x", name)]:
            seen = [list(map(float, row[column:column + 3])) for row in rows if row[column]]
            distance = max(math.dist(at, seen[0]) for at in seen)
            if distance > 1e-5:
                far[names[column].removesuffix(".x")] = distance
        return far

    def test_only_the_parts_that_are_asked_for_move_and_as_strongly(self):
        all_of_it = self.moving(self.take)
        brows = self.moving(self.take, "--only", "brows")
        self.assertEqual(set(brows), {name for name in all_of_it if name.startswith("4.")})
        self.assertEqual(brows, {name: all_of_it[name] for name in brows})
        rest = self.moving(self.take, "--without", "brows,mouth", "--strength", "jaw=0.5")
        self.assertFalse([name for name in rest if name.split(".")[0] in ("4", "8")])
        self.assertAlmostEqual(rest["2.1"] / all_of_it["2.1"], 0.5, places=3)

    def test_two_takes_are_merged_by_their_parts(self):
        all_of_it = self.moving(self.take)
        both = self.moving(self.take, "--only", "brows", TAKE, "--only", "mouth")
        self.assertEqual({name.split(".")[0] for name in both} - {"2"}, {"4", "8"})
        self.assertEqual({name: far for name, far in both.items() if name.startswith("4.")},
                         {name: far for name, far in all_of_it.items() if name.startswith("4.")})

    def test_animate_merges_takes_as_well(self):
        report = json.loads(self.done(self.animate(self.out / "a.glb", "--only", "brows", "--take", TAKE, "--only", "jaw",
                                                   "--dry-run", "--json")).stdout)
        self.assertEqual([one["take"]["file"] for one in report["merged"]], [TAKE.name])

    def test_a_picture_gets_depth_unless_told_otherwise(self):
        picture = self.work / "picture.csv"
        rest = {"3.7": (72, 1), "3.11": (28, -1), "3.12": (-72, 1), "3.8": (-28, -1), "8.3": (41, -108), "8.4": (-41, -108),
                "2.1": (0, -174), "9.3": (0, -47)}
        rows = [",".join(["time", *(f"{name}.{axis}" for name in rest for axis in "xy")])]
        for time, drop in (("0", 0), ("0.1", 20)):
            places = [(x, y - (drop if name == "2.1" else 0)) for name, (x, y) in rest.items()]
            rows.append(",".join([time, *(str(value) for place in places for value in place)]))
        picture.write_text("\n".join(rows) + "\n", encoding="utf-8")
        for flags, word in (([], "estimated"), (["--no-depth"], "none")):
            result = self.done(run("animate", HEAD, "--points", POINTS, "--take", picture, "-o", self.out / "p.glb",
                                   "--head", "keep", "--dry-run", "--json", *flags))
            self.assertIn(word, json.loads(result.stdout)["depth"])

    def test_lids_and_lips_keep_contact_unless_told_otherwise(self):
        for flags, pairs in (([], True), (["--retarget-method", "fapu"], True), (["--no-contact"], False)):
            report = json.loads(self.done(self.animate(self.out / "a.glb", "--dry-run", "--json", *flags)).stdout)
            self.assertEqual(report["retarget"]["pairs_in_contact"] > 0, pairs)

    def test_json_is_one_object_on_stdout(self):
        rig = self.out / "r.glb"
        self.done(run("rig", HEAD, "--points", POINTS, "-o", rig))
        for arguments in (["inspect", HEAD, "--points", POINTS], ["inspect", TAKE], ["inspect", rig],
                          ["rig", HEAD, "--points", POINTS, "-o", self.out / "s.glb"],
                          ["retarget", self.take, "--rig", rig, "--map", MAP, "-o", self.out / "t.csv"],
                          ["deform", rig, self.out / "t.csv", "-o", self.out / "d.mdd"]):
            result = self.done(run(*arguments, "--json"))
            self.assertIsInstance(json.loads(result.stdout), dict, arguments)

    def test_report_is_the_same_object_in_a_file(self):
        report = self.out / "report.json"
        result = self.done(self.animate(self.out / "a.glb", "--json", "--report", report))
        self.assertEqual(json.loads(report.read_text(encoding="utf-8")), json.loads(result.stdout))

    def test_quiet_prints_nothing(self):
        result = self.done(self.animate(self.out / "a.glb", "-q"))
        self.assertEqual(result.stdout + result.stderr, "")

    def test_a_dry_run_writes_nothing(self):
        for name in ("a.glb", "a.mdd", "a.pc2", "frames"):
            self.done(self.animate(self.out / name, "--dry-run"))
        self.done(self.animate(self.out / "m.glb", "--dry-run", "--bake", "morphs"))
        self.done(run("rig", HEAD, "--points", POINTS, "-o", self.out / "r.glb", "--dry-run"))
        self.assertEqual(list(self.out.iterdir()), [])

    def test_the_help_of_every_verb_has_an_example_with_its_own_flags(self):
        listed = self.done(run("--help")).stdout
        for verb in VERBS:
            self.assertIn(verb, listed)
            text = self.done(run(verb, "--help")).stdout
            example = re.search(rf"^  (mien {verb} .*)$", text, re.MULTILINE)
            self.assertIsNotNone(example, f"mien {verb} --help has no example")
            for flag in re.findall(r"--[a-z-]+", example.group(1)):
                self.assertIn(flag, text[:example.start()], f"mien {verb} --help does not explain {flag}")

    def test_the_version_is_the_one_of_the_build(self):
        stated = re.search(r"project\(mien VERSION ([0-9.]+)", (program.ROOT / "CMakeLists.txt").read_text()).group(1)
        self.assertIn(stated, self.done(run("--version")).stdout)

    def test_the_same_bytes_from_any_number_of_threads(self):
        for name in ("a.glb", "a.mdd", "m.glb"):
            bake = ("--bake", "morphs") if name == "m.glb" else ()
            written = []
            for threads in (1, 2, 8):
                self.done(self.animate(self.out / name, "--threads", threads, "-f", *bake))
                written.append((self.out / name).read_bytes())
            self.assertEqual(written[0], written[1], name)
            self.assertEqual(written[0], written[2], name)

    def test_the_same_bytes_from_any_locale_time_zone_and_folder(self):
        self.done(self.animate(self.out / "a.glb"))
        self.done(self.animate(self.out / "b.glb", cwd="/", LC_ALL="de_DE.UTF-8", LANG="de_DE.UTF-8",
                               TZ="Asia/Kathmandu"))
        self.assertEqual((self.out / "a.glb").read_bytes(), (self.out / "b.glb").read_bytes())

    def test_point_caches_hold_every_vertex_of_every_row(self):
        vertices = json.loads(self.done(run("inspect", HEAD, "--json")).stdout)["vertices"]
        for name in ("a.mdd", "a.pc2"):
            self.done(self.animate(self.out / name))
        mdd = (self.out / "a.mdd").read_bytes()
        self.assertEqual(struct.unpack(">ii", mdd[:8]), (ROWS, vertices))
        self.assertEqual(len(mdd), 8 + 4 * ROWS + 12 * ROWS * vertices)
        pc2 = (self.out / "a.pc2").read_bytes()
        self.assertEqual(struct.unpack("<12s2i", pc2[:20]), (b"POINTCACHE2\0", 1, vertices))
        self.assertEqual(struct.unpack("<i", pc2[28:32]), (ROWS,))
        self.assertEqual(len(pc2), 32 + 12 * ROWS * vertices)
        big, little = array.array("f", mdd[8 + 4 * ROWS:]), array.array("f", pc2[32:])
        big.byteswap()
        self.assertEqual(big, little)
        self.assertTrue(all(map(math.isfinite, big)))

    def test_a_folder_of_obj_files_has_one_per_row(self):
        self.done(self.animate(self.out / "frames"))
        self.assertEqual(len(list((self.out / "frames").glob("*.obj"))), ROWS)

    def test_animate_is_rig_retarget_and_deform_in_one(self):
        rig, onto = self.out / "r.glb", self.out / "onto.csv"
        self.done(run("rig", HEAD, "--points", POINTS, "-o", rig))
        self.done(run("retarget", self.take, "--rig", rig, "--map", MAP, "-o", onto))
        self.done(run("deform", rig, onto, "-o", self.out / "steps.mdd"))
        self.done(self.animate(self.out / "one.mdd"))
        one, steps = (array.array("f", (self.out / name).read_bytes()[8 + 4 * ROWS:])
                      for name in ("one.mdd", "steps.mdd"))
        one.byteswap()
        steps.byteswap()
        self.assertEqual(len(one), len(steps))
        size = max(one) - min(one)
        moved = max(abs(a - b) for a, b in zip(one, one[:len(one) // ROWS] * ROWS))
        self.assertGreater(moved, 0.003 * size, "the head does not move")
        # The one-step rig leaves out points that the take does not drive, the rig file carries them by the skin.
        self.assertLess(max(abs(a - b) for a, b in zip(one, steps)), 0.5 * moved)

    @unittest.skipUnless(SHARED.is_dir(), "no data beside the project")
    def test_points_that_a_head_lacks_are_named_written_and_work_everywhere(self):
        few = {name: value for name, value in json.loads(POINTS.read_text(encoding="utf-8"))["points"].items()
               if name[:2] in ("3.", "4.", "8.", "9.")}
        points, more, rig = (self.out / name for name in ("few.json", "more.json", "r.glb"))
        points.write_text(json.dumps({"points": few}), encoding="utf-8")
        said = json.loads(self.done(run("points", HEAD, "--points", points, "--count", "6", "-o", more, "--json")).stdout)
        names = [entry["point"] for entry in said["suggested"]]
        self.assertEqual(names[0], "2.10")
        self.assertLessEqual(len(names), 6)
        self.assertTrue(all(entry["saves"] > 0 for entry in said["suggested"]))
        written = json.loads(more.read_text(encoding="utf-8"))["points"]
        self.assertEqual(set(written), set(few) | set(names))
        written["wart"] = 5
        more.write_text(json.dumps({"points": written}), encoding="utf-8")
        self.done(run("rig", HEAD, "--points", more, "-o", rig))
        header = "time," + ",".join(f"M{i}.{axis}" for i in range(4) for axis in "xyz")
        take, markers, onto = (self.out / name for name in ("t.csv", "m.csv", "onto.csv"))
        take.write_text(header + "\n0,0,0,0,1,0,0,0,1,0,0,0,1\n1,0,0,0,1,0,0,0,1,0,0,0.5,1\n", encoding="utf-8")
        markers.write_text("M0,8.3\nM1,8.4\nM2,9.3\nM3,wart\n", encoding="utf-8")
        self.done(run("retarget", take, "--rig", rig, "--map", markers, "--head", "keep", "-o", onto))
        self.assertIn("wart.x", onto.read_text(encoding="utf-8").splitlines()[0])

    def test_a_head_of_too_few_points_gets_no_suggestions(self):
        points = self.work / "three.points.json"
        points.write_text('{"8.3": 1, "8.4": 20, "9.3": 300}', encoding="utf-8")
        self.refused(run("points", HEAD, "--points", points, "-o", self.out / "p.json"), 1, "at least 4")

    def test_a_real_head_performs_a_real_take(self):
        head, capture = SHARED / "mh-caucasian", SHARED / "markers-41"
        result = self.done(run("animate", head / "mh-caucasian-female.glb", "--points", head / "points-glb.json",
                               "--take", capture / "jaw.trc", "--map", capture / "markers-to-fdp.json", "-o",
                               self.out / "a.glb", "--json"))
        self.assertLess(json.loads(result.stdout)["influence_cut"]["max_error_share_of_height"], 0.05)


if __name__ == "__main__":
    unittest.main()

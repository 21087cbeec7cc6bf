# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The add-on's zip has what Blender asks of one. usage: MIEN=build/release/mien addon_zip_test.py"""
import ast
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
from program import run


class AddOnZip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder) / name for name in ("a.zip", "b.zip")]
            for path in paths:
                subprocess.run([sys.executable, "-B", ROOT / "blender" / "build_zip.py", path], check=True, stdout=subprocess.DEVNULL)
            cls.bytes = [path.read_bytes() for path in paths]
            with zipfile.ZipFile(paths[0]) as file:
                cls.files = {name: file.read(name).decode() for name in file.namelist()}
        cls.version = re.search(r"\d+\.\d+\.\d+", run("--version").stdout).group()

    def test_two_builds_are_the_same_bytes(self):
        self.assertEqual(*self.bytes)

    def test_it_is_one_folder_with_modules_that_import_each_other_by_relation(self):
        self.assertEqual({name.split("/")[0] for name in self.files}, {"mien"})
        self.assertIn("mien/LICENSE", self.files)
        for name, text in self.files.items():
            if name.endswith(".py"):
                compile(text, name, "exec")
                self.assertNotRegex(text, r"(?m)^(from|import) mien", name)

    def test_blender_reads_its_name_and_the_project_s_version_without_running_it(self):
        lines = ast.parse(self.files["mien/__init__.py"]).body
        info = next(ast.literal_eval(line.value) for line in lines if isinstance(line, ast.Assign))
        self.assertEqual((info["name"], info["blender"]), ("mien", (3, 4, 0)))
        self.assertEqual(".".join(map(str, info["version"])), self.version)

    def test_the_manifest_keeps_the_rules_for_extensions(self):
        manifest = tomllib.loads(self.files["mien/blender_manifest.toml"])
        self.assertEqual([manifest[key] for key in ("schema_version", "id", "version", "type", "blender_version_min", "license")],
                         ["1.0.0", "mien", self.version, "add-on", "4.2.0", ["SPDX:MIT"]])
        for sentence in (manifest["tagline"], *manifest["permissions"].values()):
            self.assertLessEqual(len(sentence), 64)
            self.assertRegex(sentence, r"\w$")
        self.assertTrue(all(re.fullmatch(r"\d{4}(-\d{4})? \S.*", line) for line in manifest["copyright"]))


if __name__ == "__main__":
    unittest.main()

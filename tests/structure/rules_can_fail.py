# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Each rule over the tree complains about a small tree that breaks it, and only then.

usage: rules_can_fail.py
"""
import pathlib
import shutil
import tempfile
import unittest

import files_stay_small
import headers_are_our_own
import headers_compile_alone
import headers_have_tests
import includes_point_inward
import layout_is_clang_format
import links_lead_somewhere

LICENCE = "// SPDX-License-Identifier: MIT\n// Copyright (c) 2026 the mien authors\n\n"


class Rules(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        for name in headers_have_tests.EXEMPT:
            self.write(f"include/mien/{name}", LICENCE + "#pragma once\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def expect(self, complaints, *words):
        """The rule complains once, in a sentence with these words; without words it does not complain."""
        seen, sentences = complaints(self.root)
        self.assertTrue(seen)
        self.assertEqual(len(sentences), 1 if words else 0, sentences)
        for word in words:
            self.assertIn(word, sentences[0])

    def test_an_algorithm_that_includes_io_is_found(self):
        self.write("src/algorithms/a.cpp", '#include "mien/mesh.hpp"\n#include "algorithms/b.hpp"\n#include "c.hpp"\n')
        self.expect(includes_point_inward.complaints)
        self.write("include/mien/algorithms/a.hpp", '#include "mien/io/read.hpp"\n')
        self.expect(includes_point_inward.complaints, "algorithms/a.hpp", "mien/io/read.hpp")

    def test_io_that_includes_an_algorithm_s_private_header_is_found(self):
        self.write("src/io/a.cpp", '#include "algorithms/b.hpp"\n')
        self.expect(includes_point_inward.complaints, "src/io/a.cpp")

    def test_a_noun_that_includes_a_room_is_found(self):
        self.write("include/mien/mesh.hpp", '#include "mien/io/read.hpp"\n')
        self.expect(includes_point_inward.complaints, "mesh.hpp", "nouns")

    def test_a_library_file_that_includes_a_front_is_found(self):
        self.write("src/io/a.cpp", '#include "cli/verb.hpp"\n')
        self.expect(includes_point_inward.complaints, "no front")

    def test_a_third_party_header_is_found(self):
        self.write("include/mien/a.hpp", "#include <string_view>\n")
        self.expect(headers_are_our_own.complaints)
        self.write("include/mien/a.hpp", "#include <Eigen/Core>\n")
        self.expect(headers_are_our_own.complaints, "<Eigen/Core>")

    def test_a_third_party_type_is_found(self):
        self.write("include/mien/a.hpp", "void f(const Eigen::VectorXd& x);\n")
        self.expect(headers_are_our_own.complaints, "Eigen")

    def test_a_header_that_needs_another_is_found(self):
        compiler = shutil.which("c++") or shutil.which("g++") or shutil.which("clang++-14")
        rule = lambda root: headers_compile_alone.complaints(root, compiler, self.root / "work")
        self.expect(rule)
        self.write("include/mien/a.hpp", "#pragma once\nstd::string name();\n")
        self.expect(rule, "include/mien/a.hpp")

    def test_a_long_file_is_found(self):
        self.write("src/a.cpp", LICENCE + "int a;\n" * 597)
        self.expect(files_stay_small.complaints)
        self.write("src/a.cpp", LICENCE + "int a;\n" * 598)
        self.expect(files_stay_small.complaints, "601 lines")

    def test_a_long_function_is_found(self):
        self.write("src/a.cpp", LICENCE + "int f(int a) {\n" + "    ++a;\n" * 78 + "}\n")
        self.expect(files_stay_small.complaints)
        self.write("src/a.cpp", LICENCE + "int f(int a,\n      int b) {\n" + "    ++a;\n" * 78 + "}\n")
        self.expect(files_stay_small.complaints, "81 lines")

    def test_a_long_member_function_is_found(self):
        self.write("src/a.cpp", LICENCE + "struct A {\n    int f(int a) {\n" + "        ++a;\n" * 79 + "    }\n};\n")
        self.expect(files_stay_small.complaints, "81 lines")

    def test_work_left_for_later_is_found(self):
        self.write("tools/a.py", LICENCE.replace("//", "#") + "# TO" + "DO: later\n")
        self.expect(files_stay_small.complaints, "tools/a.py:4")

    def test_a_missing_licence_is_found(self):
        self.write("src/a.cpp", "int a;\n")
        self.expect(files_stay_small.complaints, "licence")

    def test_a_header_without_a_test_is_found(self):
        self.expect(headers_have_tests.complaints)
        self.write("include/mien/io/a.hpp", "")
        self.expect(headers_have_tests.complaints, "tests/io/a_test.cpp")

    def test_a_broken_link_is_found(self):
        self.write("docs/a.md", "[b](../README.md#top) [c](https://example.org)")
        self.write("README.md", "[a](docs/a.md)")
        self.expect(links_lead_somewhere.complaints)
        self.write("docs/a.md", "[b](b.md)")
        self.expect(links_lead_somewhere.complaints, "docs/a.md", "b.md")

    @unittest.skipUnless(shutil.which(layout_is_clang_format.TOOL), "clang-format-14 is not installed")
    def test_another_layout_is_found(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.expect(layout_is_clang_format.complaints)
        self.write("src/a.cpp", "int  a ;\n")
        self.expect(layout_is_clang_format.complaints, "src/a.cpp")


if __name__ == "__main__":
    unittest.main()

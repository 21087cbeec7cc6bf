# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Every public header has a test of the same stem in the same folder under tests/.

usage: headers_have_tests.py ROOT
"""
import pathlib
import rule

# Plain structs, or functions too small to fail apart from what uses them.
EXEMPT = {
    "error.hpp": "a struct",
    "fdp.hpp": "a struct; io/fdp_text_test.cpp tests what fills it",
    "measured_point.hpp": "a struct",
    "mesh_sequence.hpp": "two structs",
    "picture.hpp": "a struct",
    "retarget.hpp": "a struct; algorithms/retarget_test.cpp tests what fills it",
    "rig.hpp": "structs; the tests of every rigger fill them",
    "algorithms/reading.hpp": "an enumeration",
}


def complaints(root):
    seen = [path.relative_to("include/mien") for path in rule.files(root, ("*.hpp",), ("include/mien",))]
    sentences = []
    for header in seen:
        test = pathlib.Path("tests", header.parent, header.stem + "_test.cpp")
        if header.as_posix() not in EXEMPT and not (root / test).is_file():
            sentences.append(f"include/mien/{header} has no {test}")
    sentences += [f"{name} is exempt from having a test, but there is no such header" for name in EXEMPT
                  if not (root / "include/mien" / name).is_file()]
    return seen, sentences


if __name__ == "__main__":
    rule.main(complaints, "public headers")

# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Public headers include the standard library and each other, nothing of a third party.

usage: headers_are_our_own.py ROOT
"""
import re
import rule

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
STANDARD = re.compile(r"[a-z_]+")  # <vector>, <string_view>: a standard header has neither folder nor extension
THIRD_PARTY = re.compile(r"\b(Eigen|nlohmann|fmt|tbb|CLI|draco|meshopt|cholmod)::")


def complaints(root):
    seen = rule.files(root, folders=("include",))
    sentences = []
    for path in seen:
        text = (root / path).read_text(encoding="utf-8")
        for bracket, name in INCLUDE.findall(text):
            if bracket == "<" and not STANDARD.fullmatch(name):
                sentences.append(f"{path}: includes <{name}>, which is not the standard library's")
            if bracket == '"' and not (name.startswith("mien/") and (root / "include" / name).is_file()):
                sentences.append(f'{path}: includes "{name}", which is no public header of mien')
        for name in THIRD_PARTY.findall(text):
            sentences.append(f"{path}: names a type of {name}; third-party types stay inside .cpp files")
    return seen, sentences


if __name__ == "__main__":
    rule.main(complaints, "public headers")

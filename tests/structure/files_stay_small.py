# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Files end at 600 lines and functions at 80; every file opens with its licence; nothing is left to do later.

usage: files_stay_small.py ROOT
Functions are found by the layout that clang-format gives them: an opening line at the margin, or in a class body, and a
closing brace in the same column.
"""
import re
import rule

FILE_LINES = 600
FUNCTION_LINES = 80
LICENCE = ("SPDX-License-Identifier: MIT", "Copyright (c) 2026 the mien authors")
LATER = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
NOT_A_FUNCTION = re.compile(r"^\s*((?:public|protected|private):|namespace|struct|class|union|enum|extern|using|constexpr [^(]*=|const [^(]*=|\}|//|#)")


def opening(lines, start):
    """Number of lines of the declaration that begins at `start` when it opens a body, or 0."""
    for length in range(1, 12):
        text = lines[start + length - 1] if start + length <= len(lines) else ";"
        if text.endswith("{"):
            return length if "(" in "".join(lines[start:start + length]) else 0
        if text.endswith((";", "}")) or not text:
            return 0
    return 0


def functions(lines):
    """(first line from 1, length) of every function body in the lines of a formatted C++ file."""
    found = []
    after = 0
    for start, line in enumerate(lines):
        margin = re.match(r"^( {4})?(?=\S)", line)
        if start < after or not margin or NOT_A_FUNCTION.match(line) or not opening(lines, start):
            continue
        end = next((i for i in range(start + 1, len(lines)) if lines[i].startswith(margin.group() + "}")), start)
        found.append((start + 1, end - start + 1))
        after = end
    return found


def complaints(root):
    seen = rule.files(root, rule.SOURCE + ("*.py", "*.mjs"), rule.FOLDERS + ("tools",))
    sentences = []
    for path in seen:
        lines = (root / path).read_text(encoding="utf-8").splitlines()
        if len(lines) > FILE_LINES:
            sentences.append(f"{path}: {len(lines)} lines; split it along a noun or a verb, {FILE_LINES} is the end")
        if not all(any(words in line for line in lines[:4]) for words in LICENCE):
            sentences.append(f"{path}: does not open with the two licence lines")
        sentences += [f"{path}:{number}: {match.group()} is not for later" for number, line in enumerate(lines, 1)
                      if (match := LATER.search(line))]
        if path.suffix in (".cpp", ".hpp"):
            sentences += [f"{path}:{start}: a function of {length} lines; {FUNCTION_LINES} is the end"
                          for start, length in functions(lines) if length > FUNCTION_LINES]
    return seen, sentences


if __name__ == "__main__":
    rule.main(complaints)

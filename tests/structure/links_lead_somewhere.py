# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""A link from one document of the tree to another file of the tree leads to a file.

usage: links_lead_somewhere.py ROOT
"""
import re
import rule

LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")


def complaints(root):
    seen = rule.files(root, ("*.md",), ("docs", "samples", "examples", "bench", "maya")) + \
        [path.relative_to(root) for path in sorted(root.glob("*.md"))]
    sentences = []
    for path in seen:
        for target in LINK.findall((root / path).read_text(encoding="utf-8")):
            if "://" not in target and not (root / path.parent / target).exists():
                sentences.append(f"{path}: links to {target}, which is not there")
    return seen, sentences


if __name__ == "__main__":
    rule.main(complaints, "documents")

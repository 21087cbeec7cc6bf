# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Takes the C++ fragment out of the README, so that it is compiled, linked and run as it stands there.

usage: readme_fragment.py README.md OUT.cpp
Its includes stay outside of the function that its statements go into. Fails unless there is one fragment.
"""
import pathlib
import re
import sys


def program(readme):
    fragments = re.findall(r"^```cpp\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
    if len(fragments) != 1:
        sys.exit(f"README.md: expected one C++ fragment (```cpp), found {len(fragments)}")
    lines = fragments[0].splitlines()
    includes = [line for line in lines if line.startswith("#include")]
    statements = [line for line in lines if line not in includes and line.strip()]
    if not includes or not statements:
        sys.exit("README.md: expected includes and statements in the C++ fragment")
    return "\n".join(includes) + "\n\nint main() {\n" + "\n".join("    " + line for line in statements) + "\n}\n"


pathlib.Path(sys.argv[2]).write_text(program(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")), encoding="utf-8")

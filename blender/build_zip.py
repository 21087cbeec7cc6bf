# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Makes the add-on's zip, which Blender installs: the modules, the calls they share with Maya, the licence, the version.

usage: build_zip.py OUT.zip
"""
import pathlib
import re
import sys
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]


def version() -> str:
    """The project's, which stands in one place."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(\s*mien\s+VERSION\s+(\d+\.\d+\.\d+)", text).group(1)


def contents() -> "dict[str, bytes]":
    """Path in the zip -> bytes."""
    number = version()
    found = {"mien/LICENSE": (ROOT / "LICENSE").read_bytes()}
    for folder, inside in ((ROOT / "blender" / "mien", "mien"), (ROOT / "python" / "mien_calling", "mien/mien_calling")):
        for path in sorted([*folder.glob("*.py"), *folder.glob("*.toml")]):
            text = path.read_text(encoding="utf-8")
            text = text.replace('"version": (0, 0, 0)', f'"version": ({number.replace(".", ", ")})')
            text = text.replace('version = "0.0.0"', f'version = "{number}"')
            found[f"{inside}/{path.name}"] = text.encode()
    return found


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip().splitlines()[-1])
    with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in sorted(contents().items()):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes every time
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            file.writestr(entry, data)
    print(f"{sys.argv[1]}: mien {version()} for Blender")


if __name__ == "__main__":
    main()

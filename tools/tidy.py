#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Runs clang-tidy over every source of ours that a build compiles and remembers which were clean.

usage: tidy.py BUILD JOBS
A source takes half a minute, most of it for headers that never change. So what was clean is not looked at again while
its text with everything that it includes, comments too, and the checks are the same; BUILD/tidy keeps the names.
"""
import concurrent.futures
import hashlib
import json
import os
import shlex
import subprocess
import sys

TIDY = "clang-tidy-14"


def sources(build):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = {os.path.relpath(entry["file"]): entry for entry in json.load(file)}
    return {name: entries[name] for name in sorted(entries) if not name.startswith("build/")}


def checks_of(name):
    """The text of every .clang-tidy that holds for a source."""
    folders = [""]
    for part in os.path.dirname(name).split("/"):
        folders.append(os.path.join(folders[-1], part))
    files = [os.path.join(folder, ".clang-tidy") for folder in dict.fromkeys(folders)]
    return b"".join(open(file, "rb").read() for file in files if os.path.exists(file))


def state_of(name, entry):
    """A name for all that clang-tidy sees of a source."""
    words = shlex.split(entry["command"])
    out = words.index("-o")
    words = [word for word in words[:out] + words[out + 2:] if word != "-c"]
    if os.path.basename(words[0]) == "ccache":
        words = words[1:]
    text = subprocess.run(words + ["-E", "-C"], cwd=entry["directory"], stdout=subprocess.PIPE, check=True).stdout
    return hashlib.sha256(text + checks_of(name)).hexdigest()


def look(build, name, entry):
    """What clang-tidy says of a source; nothing where it is clean, None where it was clean before."""
    mark = os.path.join(build, "tidy", state_of(name, entry))
    if os.path.exists(mark):
        return None
    done = subprocess.run([TIDY, "-p", build, "--quiet", name], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode == 0 and not done.stdout.strip():
        open(mark, "w", encoding="utf-8").close()
        return ""
    return done.stdout or done.stderr or f"{name}: {TIDY} ended with {done.returncode}"


def main(build, jobs):
    os.makedirs(os.path.join(build, "tidy"), exist_ok=True)
    entries = sources(build)
    found = known = 0
    with concurrent.futures.ThreadPoolExecutor(int(jobs)) as pool:
        for said in pool.map(lambda item: look(build, *item), entries.items()):
            known += said is None
            found += bool(said)
            if said:
                print(said, flush=True)
    print(f"clang-tidy: {len(entries)} files, {known} of them clean before and unchanged, {found} with findings")
    return 1 if found or not entries else 0


sys.exit(main(*sys.argv[1:]))

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Runs mien on a corpus of malformed files with the corpus' own checker and holds the result against our promise.

usage: malformed.py CORPUS MIEN
No crash, sanitizer report, hang, silent failure or left-over file; at least 98 % of the files that should be accepted
are, and at least 98 % of those that should be refused are.
"""
import os
import re
import subprocess
import sys

PROMISE = 0.98


def run(corpus, formats, command):
    checker = os.path.join(corpus, "tools", "run_corpus.py")
    done = subprocess.run(
        [sys.executable, "-B", checker, "-f", formats, "--jobs", str(os.cpu_count()), command],
        stdout=subprocess.PIPE, text=True)
    print(done.stdout, end="", flush=True)
    verdicts = re.search(r"accept (\d+) of (\d+), reject (\d+) of (\d+)", done.stdout)
    if verdicts is None:
        sys.exit("the checker printed no verdicts")
    return done.returncode, [int(number) for number in verdicts.groups()]


def main(corpus, mien):
    mien = os.path.abspath(mien)
    if not os.access(mien, os.X_OK):
        print(f"malformed files: not checked, since the program {os.path.relpath(mien)} is not there; build it first")
        return 1
    base = os.path.abspath(os.path.join(corpus, "degenerate", "00_base.obj"))
    bad = 0
    total = [0, 0, 0, 0]
    for formats, command in (
        ("gltf,glb,obj,off,ply,trc,csv", f"{mien} inspect {{file}}"),
        ("fdp", f"{mien} inspect {base} --points {{file}}"),
    ):
        print(f"-- {formats}")
        status, verdicts = run(corpus, formats, command)
        bad |= status
        total = [a + b for a, b in zip(total, verdicts)]
    # What of FBX is right or wrong Assimp decides; only how it ends is our promise.
    print("-- fbx")
    bad |= run(corpus, "fbx", f"{mien} inspect {{file}}")[0]
    right, accepts, refused, rejects = total
    kept = accepts > 0 and rejects > 0 and right >= PROMISE * accepts and refused >= PROMISE * rejects
    print(f"malformed files: accepts {right} of {accepts}, rejects {refused} of {rejects}, "
          f"{'with' if bad else 'no'} crash, report, hang or left-over file")
    return 1 if bad or not kept else 0


sys.exit(main(*sys.argv[1:]))

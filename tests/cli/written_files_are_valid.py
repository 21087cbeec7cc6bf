# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The Khronos validator finds no error and no warning in what mien writes.

usage: MIEN=build/release/mien written_files_are_valid.py
The sample head in every form, and, where they lie beside the project, real heads with real takes.
Exit status 77 (skipped) where the validator is not installed; ./check installs it.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

from program import HEAD, MAP, POINTS, ROOT, SHARED, TAKE, run

JOINTS, EIGHT, MORPHS = (), ("--influences", "8"), ("--bake", "morphs")
FORMS = {"joints": JOINTS, "eight": EIGHT, "morphs": MORPHS, "head-motion": ("--head-motion",)}


def performances():
    """(name, head, points, take, map, forms) of everything that is to be written."""
    yield "sample", HEAD, POINTS, TAKE, MAP, FORMS
    if not SHARED.is_dir():
        print("no data beside the project: real heads left out")
        return
    capture = SHARED / "markers-41"
    names = capture / "markers-to-fdp.json"
    caucasian = SHARED / "mh-caucasian"
    female = (caucasian / "mh-caucasian-female.glb", caucasian / "points-glb.json")
    suzanne = SHARED / "suzanne"
    ict = SHARED / "ict"
    for take in ("jaw", "eyebrows"):
        yield f"caucasian-{take}", *female, capture / f"{take}.trc", names, FORMS if take == "jaw" else {"joints": ()}
    yield "caucasian-obj", caucasian / "mh-caucasian-female.obj", caucasian / "points-obj.json", capture / "jaw.trc", \
        names, {"joints": JOINTS}
    for head in ("suzi", "suzi-draco"):
        yield head, suzanne / f"{head}.glb", suzanne / "points.json", capture / "jaw.trc", names, {"joints": JOINTS}
    yield "ict", ict / "ict_neutral.obj", ict / "feature_points.json", capture / "jaw.trc", names, \
        {"joints": JOINTS, "morphs": MORPHS}


def shaped():
    """(name, head, points) of heads that are to get shapes."""
    yield "sample-shapes", HEAD, POINTS
    if SHARED.is_dir():
        caucasian, suzanne, ict = SHARED / "mh-caucasian", SHARED / "suzanne", SHARED / "ict"
        for sex in ("female", "male"):
            yield f"caucasian-{sex}-shapes", caucasian / f"mh-caucasian-{sex}.glb", caucasian / "points-glb.json"
        yield "suzanne-shapes", suzanne / "suzi.glb", suzanne / "points.json"
        yield "ict-shapes", ict / "ict_neutral.obj", ict / "feature_points.json"


def tabled():
    """(name, head, points) of heads that are to get face animation tables."""
    yield "sample-table", HEAD, POINTS
    if SHARED.is_dir():
        yield "ict-table", SHARED / "ict" / "ict_neutral.obj", SHARED / "ict" / "feature_points.json"


def talk():
    """A jaw that opens, eyes that look aside, a head that turns."""
    sent = (3, 23, 24, 49)
    mask = " ".join("1" if fap in sent else "0" for fap in range(1, 69))
    rows = (f"{mask}\n{i} {60 * i} {900 * i} {900 * i} {2000 * i}\n" for i in range(12))
    return "2.1 talk 25 12\n" + "".join(rows)


def write_all(folder):
    """Writes everything; gives back the files and what went wrong."""
    written, wrong, rigged = [], [], set()
    for name, head, points, take, names, forms in performances():
        calls = {form: ("animate", head, "--points", points, "--take", take, "--map", names, *flags)
                 for form, flags in forms.items()}
        if head not in rigged:
            calls["rig"] = ("rig", head, "--points", points)
            rigged.add(head)
        for form, call in calls.items():
            output = folder / f"{name}-{form}.glb"
            result = run(*call, "-o", output)
            if result.returncode:
                wrong.append(f"mien {' '.join(map(str, call))}: {result.stderr}")
            else:
                written.append(output)
    for name, head, points in shaped():
        output = folder / f"{name}.glb"
        result = run("shapes", head, "--points", points, "-o", output)
        if result.returncode:
            wrong.append(f"mien shapes {head}: {result.stderr}")
        else:
            written.append(output)
    for name, head, points in tabled():
        rig, table, faps = folder / f"{name}-rig.glb", folder / f"{name}.fat", folder / "talk.fap"
        faps.write_text(talk(), encoding="utf-8")
        calls = (("rig", head, "--points", points, "-o", rig), ("fat", rig, "-o", table),
                 ("fat", table, "-o", folder / f"{name}-by-parameters.glb"),
                 ("play", table, faps, "-o", folder / f"{name}-plays.glb"),
                 ("play", table, faps, "--head-motion", "-o", folder / f"{name}-plays-and-turns.glb"))
        for call in calls:
            result = run(*call)
            if result.returncode:
                wrong.append(f"mien {' '.join(map(str, call))}: {result.stderr}")
            elif call[-1].suffix == ".glb":
                written.append(call[-1])
    return written, wrong


def judge(*files):
    """Exit status of the validator: 0 valid, 1 not, 77 not installed."""
    if shutil.which("node") is None:
        return 77
    return subprocess.run(["node", ROOT / "tools" / "validate_gltf.mjs", *files]).returncode


def main(folder):
    garbage = folder / "garbage.glb"
    garbage.write_bytes(HEAD.read_bytes()[:-8])
    print("a file cut short, which the judge has to refuse:", flush=True)
    status = judge(garbage)
    if status == 77:
        print("the glTF validator is not installed: written files not checked; tools/setup node installs it")
        return 77
    if status == 0:
        print("the judge sees nothing wrong with a file cut short")
        return 1
    written, wrong = write_all(folder)
    print("\n".join(wrong), flush=True)
    return 1 if judge(HEAD, *written) or wrong or not written else 0


with tempfile.TemporaryDirectory() as work:
    sys.exit(main(pathlib.Path(work)))

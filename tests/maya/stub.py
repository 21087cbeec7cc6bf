# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""A stand-in for the calls of maya.cmds and maya.mel that mien_maya makes, over a scene of one head."""
import math


class Shape:
    def __init__(self, transform, positions, faces):
        self.transform = transform
        self.positions = positions  # x, y, z one after another, in the space of the mesh
        self.faces = faces
        self.rows = []  # positions at each frame from 1 on, where it moves
        self.attributes = {}
        self.switch = None


class Scene:
    """Shapes by full path; each frame lifts them by one tenth and all are turned about y by a quarter and moved by 5 along x."""

    def __init__(self, folder, program):
        self.folder, self.options = folder, {"mienProgram": program}
        self.shapes, self.members, self.selection = {}, {}, []
        self.frame, self.range = 1.0, (1.0, 24.0)
        self.up, self.rate = "y", "film"
        self.made, self.caches = 0, {}  # cache node -> what it was attached with
        self.replays = {}  # cache node -> the attribute that marks it
        self.play = {}  # switch -> whether it plays
        self.windows = 0
        self.cancels_after = math.inf
        self.steps = 0

    # ---- maya.cmds

    def upAxis(self, query, axis):
        return self.up

    def optionVar(self, query=None, exists=None):
        return self.options[query] if query else exists in self.options

    def workspace(self, query, rootDirectory):
        return str(self.folder)

    def playbackOptions(self, query, minTime=False, maxTime=False):
        return self.range[0] if minTime else self.range[1]

    def currentUnit(self, query, time):
        return self.rate

    def currentTime(self, *frame, query=False):
        if frame:
            self.frame = frame[0]
        return self.frame

    def ls(self, *names, selection=False, dagObjects=False, type=None, noIntermediate=False, long=False, flatten=False,
           objectsOnly=False):
        if type == "mesh":
            return list(self.selection if selection else self.shapes)
        if type == "objectSet":
            return list(self.members)
        if objectsOnly:
            transform = names[0].split(".")[0]
            return [path for path, shape in self.shapes.items() if shape.transform == transform]
        return list(names[0])

    def sets(self, name, query):
        return self.members[name]

    def polyEvaluate(self, path, vertex):
        return len(self.shapes[path].positions) // 3

    def polyInfo(self, path, faceToVertex):
        return [f"FACE {number:6}: " + " ".join(f"{vertex:6}" for vertex in face) + " \n"
                for number, face in enumerate(self.shapes[path].faces)]

    def xform(self, vertices, query, worldSpace, translation):
        path, component = vertices.split(".")
        assert component == "vtx[*]"
        shape = self.shapes[path]
        values = iter(shape.rows[round(self.frame) - 1] if shape.rows else shape.positions)
        lift = (self.frame - 1) / 10
        return [value for x, y, z in zip(values, values, values) for value in (z + 5, y + lift, -x)]

    def listRelatives(self, path, parent):
        return [self.shapes[path].transform]

    def listConnections(self, node, type):
        if type == "historySwitch":
            switch = self.shapes[node.split(".")[0]].switch
            return [switch] if switch else None
        return [name for name, cache in self.caches.items() if cache["inAttr"] == node + ".inp[0]"] or None

    def attributeQuery(self, name, node, exists):
        return name in (self.shapes[node].attributes if node in self.shapes else self.replays.get(node, ()))

    def addAttr(self, node, longName, dataType=None, attributeType=None):
        if node in self.caches:
            self.replays[node] = longName
        else:
            self.shapes[node].attributes[longName] = None

    def getAttr(self, name):
        node, attribute = name.split(".")
        if attribute == "worldInverseMatrix":
            return [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, -(self.frame - 1) / 10, -5, 1]
        return self.shapes[node].attributes[attribute]

    def setAttr(self, name, value, type=None):
        node, attribute = name.split(".")
        if attribute == "playFromCache":
            self.play[node] = value
        else:
            self.shapes[node].attributes[attribute] = value

    def delete(self, nodes):
        for node in nodes:
            del self.caches[node]

    def cacheFile(self, **flags):
        self.made += 1
        self.caches[f"cache{self.made}"] = flags
        return f"cache{self.made}"

    def progressWindow(self, query=False, edit=False, endProgress=False, isCancelled=False, **_flags):
        self.windows += 0 if query or edit else -1 if endProgress else 1
        self.steps += query
        return self.steps > self.cancels_after

    def error(self, sentence):
        raise RuntimeError(sentence)

    # ---- maya.mel

    def eval(self, text):
        path = text.split('"')[1]
        assert text == f'createHistorySwitch("{path}", false)'
        self.shapes[path].switch = "switch_" + self.shapes[path].transform
        return self.shapes[path].switch

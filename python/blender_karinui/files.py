"""Reads what Karinui exports: the meshes of an OBJ, the colours of a GLB, the outlines of a karinui-pattern-1."""
import json
import math
import struct


class Mesh:
    """Points in space with y up, their places on the paper (empty for a body), and triangles; metres."""

    def __init__(self, name):
        self.name, self.points, self.flat, self.faces = name, [], [], []


def meshes(path):
    found, first = [], 1
    with open(path, encoding="utf-8") as file:
        for line in file:
            key, _, rest = line.partition(" ")
            if key == "o":
                first += len(found[-1].points) if found else 0
                found.append(Mesh(rest.strip()))
            elif key == "v":
                found[-1].points.append(tuple(map(float, rest.split())))
            elif key == "vt":
                found[-1].flat.append(tuple(map(float, rest.split())))
            elif key == "f":
                found[-1].faces.append(tuple(int(corner.split("/", 1)[0]) - first for corner in rest.split()))
    return found


def colours(path):
    """{mesh's name: (material's name, (red, green, blue, opacity), roughness)}; colours are linear."""
    with open(path, "rb") as file:
        head = file.read(20)
        gltf = json.loads(file.read(struct.unpack("<I", head[12:16])[0]))
    found = {}
    for node in gltf["nodes"]:
        number = gltf["meshes"][node["mesh"]]["primitives"][0].get("material")
        if number is not None:
            material = gltf["materials"][number]
            look = material.get("pbrMetallicRoughness", {})
            found[node["name"]] = (material["name"], look.get("baseColorFactor", (1, 1, 1, 1)),
                                   look.get("roughnessFactor", 1))
    return found


class Outline:
    """A piece on paper: closed runs of (point, control before it, control after it), metres."""

    def __init__(self, name, runs):
        self.name, self.runs = name, runs

    def box(self):
        points = [point for run in self.runs for point, _, _ in run]
        return (min(p[0] for p in points), min(p[1] for p in points),
                max(p[0] for p in points), max(p[1] for p in points))


def _arc(start, end, bulge):
    """The cubics of a circular arc, none longer than a quarter turn: their controls and joints."""
    angle = 4 * math.atan(bulge)
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    half = (1 / bulge - bulge) / 4
    centre = (middle[0] - half * (end[1] - start[1]), middle[1] + half * (end[0] - start[0]))
    parts = max(1, math.ceil(abs(angle) / (math.pi / 2) - 1e-9))
    turn = angle / parts
    reach = 4 / 3 * math.tan(turn / 4)
    controls, at = [], (start[0] - centre[0], start[1] - centre[1])
    for part in range(parts):
        to = (at[0] * math.cos(turn) - at[1] * math.sin(turn), at[0] * math.sin(turn) + at[1] * math.cos(turn))
        controls.append((centre[0] + at[0] - reach * at[1], centre[1] + at[1] + reach * at[0]))
        controls.append((centre[0] + to[0] + reach * to[1], centre[1] + to[1] - reach * to[0]))
        if part + 1 < parts:
            controls.append((centre[0] + to[0], centre[1] + to[1]))
        at = to
    return controls


def _run(edges):
    """Edges one after the other as points with their controls."""
    points, before, after = [], [], []
    for edge in edges:
        start, end = edge["start"], edge["end"]
        if edge["kind"] == "cubic":
            controls = edge["controls"]
        elif edge["kind"] == "arc" and edge["bulge"]:
            controls = _arc(start, end, edge["bulge"])
        else:
            third = [(end[0] - start[0]) / 3, (end[1] - start[1]) / 3]
            controls = [(start[0] + third[0], start[1] + third[1]), (end[0] - third[0], end[1] - third[1])]
        points.append(start)
        after.append(controls[0])
        before.append(controls[-1])  # of the next edge's start
        for joint in range(1, len(controls) - 2, 3):
            before.insert(len(before) - 1, controls[joint])
            points.append(controls[joint + 1])
            after.append(controls[joint + 2])
    before.insert(0, before.pop())
    return list(zip(points, before, after))


def outlines(path):
    with open(path, encoding="utf-8") as file:
        pattern = json.load(file)
    return [Outline(piece["name"], [_run(edges) for edges in [piece["outline"], *piece["holes"]]])
            for piece in pattern["pieces"]]

"""The garment of a document as objects of Blender: a collection with its body, a mesh for each piece (its UV is the
pattern on paper, in metres) and the pattern's outlines as curves at true size, laid out beside it. Updating keeps
objects, materials and whatever was done to them."""
import pathlib
import tempfile

import bpy

from . import files

DOCUMENT, PART = "karinui_document", "karinui_part"  # properties of the collection and of its objects
BODY, PIECE, OUTLINE = "body", "piece", "outline"
GAP = 0.1  # metres between outlines


def document_of(context):
    """The document of the active object's garment, else of the only one; nothing where there is none."""
    held = [c for c in bpy.data.collections if DOCUMENT in c]
    active = context.active_object
    for collection in held:
        if active and active.name in collection.objects:
            return collection
    return held[0] if len(held) == 1 else None


def _place(point):
    return (point[0], -point[2], point[1])  # Karinui has y up, Blender z


def _fill(mesh, shape):
    """Gives a mesh its shape; where its triangles are the same only its points move."""
    points = [coordinate for point in shape.points for coordinate in _place(point)]
    corners = [index for face in shape.faces for index in face]
    same = len(mesh.vertices) == len(shape.points) and len(mesh.loops) == len(corners)
    if same:
        present = [0] * len(corners)
        mesh.loops.foreach_get("vertex_index", present)
        same = present == corners
    if same:
        mesh.vertices.foreach_set("co", points)
    else:
        mesh.clear_geometry()
        mesh.from_pydata([_place(p) for p in shape.points], [], shape.faces)
        mesh.polygons.foreach_set("use_smooth", [True] * len(shape.faces))
    if shape.flat:
        layer = mesh.uv_layers.get("pattern") or mesh.uv_layers.new(name="pattern")
        layer.data.foreach_set("uv", [c for index in corners for c in shape.flat[index][:2]])
    mesh.update()


def _material(name, colour, roughness):
    known = bpy.data.materials.get(name)
    if known:
        return known
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = colour
    shader.inputs["Roughness"].default_value = roughness
    material.diffuse_color = colour
    return material


def _curve(data, outline):
    data.dimensions = "2D"
    data.splines.clear()
    for run in outline.runs:
        spline = data.splines.new("BEZIER")
        spline.use_cyclic_u = True
        spline.bezier_points.add(len(run) - 1)
        for point, (at, before, after) in zip(spline.bezier_points, run):
            point.handle_left_type = point.handle_right_type = "FREE"
            point.co, point.handle_left, point.handle_right = (*at, 0), (*before, 0), (*after, 0)


def _object(collection, part, name, make):
    """The object that shows this part of the garment, made where there is none yet."""
    for known in collection.objects:
        if known.get(PART) == part and known.get("karinui_name") == name:
            return known
    title = f"{name} on paper" if part == OUTLINE else name
    shown = bpy.data.objects.new(title, make(title))
    shown[PART], shown["karinui_name"] = part, name
    collection.objects.link(shown)
    return shown


def show(karinui, collection):
    """Brings in how the document of `karinui` stands now. Raises Refused, and then nothing has changed."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        for ending in ("obj", "glb", "json"):
            karinui.ask("export", file=str(path / f"garment.{ending}"))
        shapes, colours = files.meshes(path / "garment.obj"), files.colours(path / "garment.glb")
        outlines = files.outlines(path / "garment.json")
    shown, right = set(), 0.0
    for shape in shapes:
        part = PIECE if shape.flat else BODY
        thing = _object(collection, part, shape.name, bpy.data.meshes.new)
        shown.add(thing)
        _fill(thing.data, shape)
        right = max([right, *(point[0] for point in shape.points)])
        if not thing.data.materials and shape.name in colours:
            thing.data.materials.append(_material(*colours[shape.name]))
    right += GAP
    for outline in outlines:
        thing = _object(collection, OUTLINE, outline.name, lambda name: bpy.data.curves.new(name, "CURVE"))
        fresh = not thing.data.splines
        _curve(thing.data, outline)
        low_u, low_v, high_u, _ = outline.box()
        if fresh:  # upright, side by side; later it stays where it was put
            thing.rotation_euler = (1.5707963267948966, 0, 0)
            thing.location = (right - low_u, 0, -low_v)
        right += high_u - low_u + GAP
        shown.add(thing)
    for thing in [o for o in collection.objects if PART in o and o not in shown]:
        bpy.data.objects.remove(thing)

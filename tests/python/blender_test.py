"""blender_test.py COMMAND ADDON: the add-on in Blender itself, without a window. Exit status 77: Blender is missing."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import bpy
except ImportError:  # outside: starts Blender, with a folder of add-ons of its own
    command, addon = sys.argv[1:3]
    if shutil.which("blender") is None:
        print("SKIPPED: blender is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scripts:
        (pathlib.Path(scripts) / "addons").mkdir()
        (pathlib.Path(scripts) / "addons" / "blender_karinui").symlink_to(addon)
        sys.exit(subprocess.run(
            ["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", __file__, "--",
             command], env={**os.environ, "BLENDER_USER_SCRIPTS": scripts, "LC_ALL": "C.UTF-8"}).returncode)

COMMAND = sys.argv[sys.argv.index("--") + 1]
SKIRT = """body size=jis9ar set="waist_girth=66cm"
set spacing=40mm
block kind=skirt length=45cm
look fabric=cotton colour=#b03040
drape
"""


def by_part(collection):
    parts = {"body": {}, "piece": {}, "outline": {}}
    for thing in collection.objects:
        parts[thing["karinui_part"]][thing.name] = thing
    return parts


def points(thing):
    return [tuple(v.co) for v in thing.data.vertices]


def uv_area(mesh):
    """Square metres of the mesh on paper."""
    uv, area = mesh.uv_layers["pattern"].data, 0
    for face in mesh.polygons:
        (a, b), (c, d), (e, f) = (uv[i].uv for i in face.loop_indices)
        area += abs((c - a) * (f - b) - (e - a) * (d - b)) / 2
    return area


class Addon(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "skirt.karinui"
        script = pathlib.Path(folder.name) / "skirt.ops"
        script.write_text(SKIRT)
        subprocess.run([COMMAND, "play", script, "-o", self.path], check=True, capture_output=True)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.preferences.addon_enable(module="blender_karinui")
        bpy.context.preferences.addons["blender_karinui"].preferences.command = COMMAND
        self.addCleanup(bpy.ops.preferences.addon_disable, module="blender_karinui")
        import blender_karinui  # found as an add-on from now on

        self.addon = blender_karinui

    def opened(self):
        self.assertEqual(bpy.ops.karinui.open(filepath=str(self.path)), {"FINISHED"})
        return bpy.data.collections["skirt"]

    def facts(self):
        (karinui,) = self.addon._open.values()
        return karinui.ask("info"), karinui.ask("measure")["measurements"]

    def test_brings_in_garment_body_and_pattern_at_true_size(self):
        parts = by_part(self.opened())
        info, measures = self.facts()
        self.assertEqual(list(parts["body"]), ["body"])
        tops = [v[2] for v in points(parts["body"]["body"])]
        self.assertAlmostEqual(max(tops) - min(tops), measures["height"], 2)
        names = {piece["name"] for piece in info["pieces"]}
        self.assertEqual(set(parts["piece"]), names)
        outlines = {thing["karinui_name"]: thing for thing in parts["outline"].values()}
        self.assertEqual(set(outlines), names)
        for piece in info["pieces"]:
            mesh = parts["piece"][piece["name"]].data
            self.assertAlmostEqual(uv_area(mesh) / piece["area_m2"], 1, 2)
            self.assertAlmostEqual(sum(f.area for f in mesh.polygons) / piece["area_m2"], 1, 1)  # cloth stretches little
            heights = [p[2] for p in points(parts["piece"][piece["name"]])]
            self.assertAlmostEqual(max(heights), measures["waist_height"], delta=0.06)
            outline = outlines[piece["name"]]
            self.assertAlmostEqual(sum(s.calc_length(resolution=64) for s in outline.data.splines),
                                   piece["perimeter_m"], 4)
            colour = mesh.materials[0].node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value
            self.assertGreater(colour[0], 3 * colour[1])  # red

    def test_drapes_anew_in_place(self):
        parts = by_part(self.opened())
        name = sorted(parts["piece"])[0]
        cloth = parts["piece"][name]
        cloth.data.materials[0].name = "mine"
        cloth.name = "renamed"
        before, pointer, outlines = points(cloth), cloth.as_pointer(), len(parts["outline"])
        self.assertEqual(bpy.ops.karinui.perform(operation="body set=\"hip_girth=97cm\""), {"FINISHED"})
        self.assertEqual(bpy.ops.karinui.drape(), {"FINISHED"})
        draped = points(cloth)
        self.assertEqual(len(draped), len(before))
        self.assertGreater(max(abs(a - b) for p, q in zip(before, draped) for a, b in zip(p, q)), 0.003)
        bpy.ops.karinui.perform(operation="set spacing=30mm")
        bpy.ops.karinui.drape()
        self.assertGreater(len(cloth.data.vertices), len(before))
        self.assertEqual((cloth.as_pointer(), cloth.name, cloth.data.materials[0].name), (pointer, "renamed", "mine"))
        for _ in range(4):
            bpy.ops.karinui.undo()
        self.assertEqual(points(cloth), before)
        bpy.ops.karinui.perform(operation=f"duplicate piece={name} name=pocket")
        self.assertIn("pocket", by_part(bpy.data.collections["skirt"])["piece"])
        bpy.ops.karinui.undo()
        parts = by_part(bpy.data.collections["skirt"])
        self.assertNotIn("pocket", parts["piece"])
        self.assertEqual(len(parts["outline"]), outlines)
        bpy.ops.karinui.redo()
        self.assertIn("pocket", by_part(bpy.data.collections["skirt"])["piece"])

    def test_refusals_are_errors_of_blender_and_change_nothing(self):
        collection = self.opened()
        before = {thing.name: points(thing) for thing in by_part(collection)["piece"].values()}
        with self.assertRaisesRegex(RuntimeError, "knit"):
            bpy.ops.karinui.perform(operation="knit piece=front")
        with self.assertRaisesRegex(RuntimeError, "needs “operation”"):
            bpy.ops.karinui.perform()
        self.assertEqual({thing.name: points(thing) for thing in by_part(collection)["piece"].values()}, before)
        self.assertEqual(self.facts()[0]["operations"], 5)
        with self.assertRaisesRegex(RuntimeError, "There is no file"):
            bpy.ops.karinui.open(filepath=str(self.path.parent / "none.karinui"))
        self.assertEqual([c.name for c in bpy.data.collections], ["skirt"])

    def test_says_what_to_do_where_the_program_is_missing_or_ends(self):
        self.opened()
        (karinui,) = self.addon._open.values()
        karinui._child.kill()
        karinui._child.wait()
        self.assertEqual(bpy.ops.karinui.drape(), {"FINISHED"}, "it is started again")
        (karinui,) = self.addon._open.values()
        bpy.ops.preferences.addon_disable(module="blender_karinui")
        self.assertFalse(karinui.alive, "it ends with the add-on")
        bpy.ops.preferences.addon_enable(module="blender_karinui")
        bpy.context.preferences.addons["blender_karinui"].preferences.command = "/nowhere/karinui"
        with self.assertRaisesRegex(RuntimeError, "/nowhere/karinui” could not be started: No such file"):
            bpy.ops.karinui.open(filepath=str(self.path))


class Curves(unittest.TestCase):
    def test_arcs_and_chains_of_cubics_are_exact(self):
        import math
        import blender_karinui.files as files

        arc = {"kind": "arc", "start": [1, 0], "end": [-1, 0], "bulge": 1}  # half a turn to the left
        line = {"kind": "line", "start": [-1, 0], "end": [1, 0]}
        run = files._run([arc, line])
        self.assertEqual([tuple(round(c, 9) for c in at) for at, _, _ in run], [(1, 0), (0, 1), (-1, 0)])
        curve = bpy.data.curves.new("arc", "CURVE")
        import blender_karinui.garment as garment

        garment._curve(curve, files.Outline("arc", [run]))
        self.assertAlmostEqual(curve.splines[0].calc_length(resolution=200), math.pi + 2, 3)
        less = files._run([{"kind": "arc", "start": [0, 0], "end": [1, 1], "bulge": -math.tan(math.pi / 8)},
                           {"kind": "cubic", "start": [1, 1], "controls": [[2, 1], [3, 2], [3, 3], [3, 4], [2, 5]],
                            "end": [0, 0]}])
        self.assertEqual([at for at, _, _ in less][2], [3, 3])
        self.assertEqual((less[2][1], less[2][2], less[0][1]), ([3, 2], [3, 4], [2, 5]))
        middle = less[0][2]  # to the right: upwards first, and round (1, 0)
        self.assertAlmostEqual(middle[0], 0)
        self.assertAlmostEqual(middle[1], 4 / 3 * math.tan(math.pi / 8))


result = unittest.main(argv=["blender_test"], verbosity=2, exit=False).result
sys.exit(0 if result.wasSuccessful() else 1)

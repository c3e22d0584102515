# A scene of `karinui bench --start` in Blender's cloth: sewing springs, self-collision, its own friction.
#   blender -b --factory-startup -t 1 -P blender_cloth.py -- SCENE.json FOLDER CAP_SECONDS
# Runs until at rest or the processor time is spent, leaves the last eleven frames in FOLDER as 00.obj ... 10.obj, and
# says what it took as JSON.
import json, math, sys, time
import bpy
from mathutils import Vector

FRAME, CALM, CALM_FRAMES, SEWING_FRAMES, MOST_FRAMES = 1 / 60, 0.005, 10, 60, 3600  # seconds; m/s

path, folder, cap = sys.argv[sys.argv.index("--") + 1:]
cap = float(cap)
given = json.load(open(path))


def zup(p):  # Blender's up is z
    return (p[0], -p[2], p[1])


def added(name, points, edges, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, edges, faces)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def capsule(a, b, radius, around=96, rings=24):  # two half balls, or one ball; sides of 1 to 2 cm
    a, b = Vector(zup(a)), Vector(zup(b))
    along = b - a
    turn = (along.normalized() if along.length else Vector((0, 0, 1))).to_track_quat("Z", "Y")
    rows = [(math.pi / 2 - math.pi * k / rings, b if k <= rings // 2 else a) for k in range(rings + 1)]
    if along.length:
        rows.insert(rings // 2 + 1, (0.0, a))
        steps = max(1, round(along.length / 0.02))
        middle = [(0.0, b + (a - b) * (k / steps)) for k in range(1, steps)]
        rows[rings // 2 + 1:rings // 2 + 1] = middle
    points, faces = [], []
    for height, centre in rows:
        for k in range(around):
            turned = 2 * math.pi * k / around
            flat = radius * math.cos(height)
            points.append(centre + turn @ Vector((flat * math.cos(turned), flat * math.sin(turned), radius * math.sin(height))))
    for row in range(len(rows) - 1):
        for k in range(around):
            c, d = row * around + (k + 1) % around, row * around + k
            faces.append((d, d + around, c + around, c))
    return points, faces


scene = bpy.context.scene
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
scene.render.fps = 60
scene.frame_start, scene.frame_end = 1, MOST_FRAMES

for c in given["capsules"]:
    points, faces = capsule(c["a"], c["b"], c["radius"])
    body = added("body", points, [], faces)
    body.modifiers.new("collision", "COLLISION")
    body.collision.thickness_outer = 0.001
    body.collision.cloth_friction = 5  # its own unit, 0 to 80; see docs/performance.md

cloth = added("cloth", [zup(p) for p in given["points"]], [tuple(s) for s in given["seams"]], [tuple(f) for f in given["faces"]])
modifier = cloth.modifiers.new("cloth", "CLOTH")
settings, contact = modifier.settings, modifier.collision_settings
area = sum(face.area for face in cloth.data.polygons)
settings.mass = given["weight"] * area / len(given["points"])
settings.quality = 5  # steps a frame
settings.time_scale = 1
settings.air_damping = 200 * settings.mass  # takes off 2 of the velocity a second
settings.tension_stiffness = settings.compression_stiffness = 0.3
settings.shear_stiffness = 0.03
settings.bending_stiffness = 0.001
settings.tension_damping = settings.compression_damping = settings.shear_damping = 0.05
settings.bending_damping = 0.001
if given["pinned"]:
    group = cloth.vertex_groups.new(name="pinned")
    group.add(given["pinned"], 1.0, "REPLACE")
    settings.vertex_group_mass = "pinned"
if given["seams"]:
    settings.use_sewing_springs = True
    settings.sewing_force_max = 0.1  # newtons; without a limit the panels are yanked through the body
contact.use_collision = bool(given["capsules"])
contact.collision_quality = 4
contact.distance_min = 0.002
contact.use_self_collision = bool(given["capsules"])
contact.self_distance_min = 0.002
contact.self_friction = 5
modifier.point_cache.frame_start, modifier.point_cache.frame_end = 1, MOST_FRAMES


def places():
    seen = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    flat = [0.0] * (3 * len(given["points"]))
    seen.vertices.foreach_get("co", flat)
    return flat


sewn_first = bool(given["seams"])
settings.effector_weights.gravity = 0 if sewn_first else 1
scene.gravity = (0, 0, -9.81)
scene.frame_set(1)
last = [places()]
calm, frames, took = 0, 0, 0.0
while calm < CALM_FRAMES and took < cap and frames < MOST_FRAMES - 1:
    began = time.process_time()
    frames += 1
    if sewn_first and frames == SEWING_FRAMES:
        settings.effector_weights.gravity = 1
    scene.frame_set(frames + 1)
    took += time.process_time() - began
    now = places()
    before = last[-1]
    fastest = math.sqrt(max(sum((now[k + j] - before[k + j]) ** 2 for j in range(3)) for k in range(0, len(now), 3))) / FRAME
    calm = calm + 1 if fastest < CALM and not (sewn_first and frames <= SEWING_FRAMES) else 0
    last = last[-CALM_FRAMES:] + [now]

for k, frame in enumerate(last):
    with open(f"{folder}/{k:02}.obj", "w") as obj:
        for p in range(0, len(frame), 3):
            obj.write(f"v {frame[p]:.7f} {frame[p + 2]:.7f} {-frame[p + 1]:.7f}\n")
        if k + 1 == len(last):
            for a, b, c in given["faces"]:
                obj.write(f"f {a + 1} {b + 1} {c + 1}\n")
print(json.dumps({"cpu_s": took, "frames": frames, "settled": calm >= CALM_FRAMES}))

"""Where cloth is stretched, worked out from the arrays that a document holds: nothing is copied.

python3 stretch.py OUT_FOLDER
"""
import sys

import numpy

import karinui

band = karinui.Document.create()
band.play("""
body size=jis9ar
set spacing=40mm
piece name=band outline="M 0 0; low L 900 0; end_right L 900 180; top L 0 180; end_left L 0 0"
place piece=band at="torso:waist@0" ease=2cm
sew a=band.end_left b=band.end_right
""")
report = band.settle()
form = band.pieces()[0].form
flat, space, faces = form.flat, form.space, form.faces
assert not flat.flags.writeable and numpy.shares_memory(flat, form.flat)


def lengths(points: numpy.ndarray) -> numpy.ndarray:
    """Of the three sides of every triangle."""
    corners = points[faces]
    return numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2)


strain = lengths(space) / lengths(flat) - 1
print(f"{len(space)} places, {len(faces)} triangles; the solver says {100 * report['strain']['mean']:.2f} % on average")
print(f"sides of triangles: {100 * numpy.abs(strain).mean():.2f} % on average, {100 * strain.max():.1f} % at most")
body = band.body()
print(f"the body: {len(body.points)} points, {body.points[:, 1].max():.3f} m high")

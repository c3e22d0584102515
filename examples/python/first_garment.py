"""A skirt from measures to paper: drafted, brought to rest, examined, printed.

python3 first_garment.py OUT_FOLDER
"""
import pathlib
import sys

import karinui

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
out.mkdir(parents=True, exist_ok=True)
with karinui.Document.create() as skirt:  # in memory; with a path it is a file
    skirt.perform("body size=jis9ar set=\"waist_girth=66cm; hip_girth=92cm\"")
    skirt.perform("set spacing=40mm")
    skirt.perform("block kind=skirt length=45cm")
    told = []
    report = skirt.settle(progress=lambda fraction, doing: told.append(fraction))
    print("At rest." if report["settled"] else report["why"])
    print(f"The deepest place in the body: {1000 * report['penetration_m']:.2f} mm")
    for level, girths in skirt.fit()["girths"].items():
        print(f"{level}: {100 * girths['ease_m']:.1f} cm of ease")
    for ending in ("pdf", "svg", "glb"):
        skirt.export(out / f"skirt.{ending}")
    try:
        skirt.perform("sew a=front.side b=back.side")
    except karinui.Error as why:
        print(f"As a person reads it: {why}")
assert report["settled"] and told

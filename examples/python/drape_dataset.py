"""Many drapes as data for learning: the same skirt in several fabrics on several figures, each a file of arrays,
and a manifest that says what each is of.

python3 drape_dataset.py OUT_FOLDER

Each DRAPE.npz holds, of all pieces one after another, `flat` (n, 2), `space` (n, 3), `faces` (m, 3) and `piece` (n), and of the figure `body` (k, 3) and `body_faces`;
metres. manifest.json has a line a drape: its file, what was varied, whether it came to rest, and what the document's hash is, by which anyone can
tell that the same program makes the same drape again.
"""
import json
import pathlib
import sys

import numpy

import karinui

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
out.mkdir(parents=True, exist_ok=True)
FABRICS = ["denim", "wool suiting", "jersey"]
WAISTS = [62, 66]  # centimetres


def arrays_of(skirt: karinui.Document) -> dict[str, numpy.ndarray]:
    forms = [piece.form for piece in skirt.pieces()]
    begins = numpy.cumsum([0] + [len(form.space) for form in forms])
    body = skirt.body()
    return {
        "flat": numpy.concatenate([form.flat for form in forms]),
        "space": numpy.concatenate([form.space for form in forms]),
        "faces": numpy.concatenate([form.faces + begin for form, begin in zip(forms, begins)]),
        "piece": numpy.repeat(numpy.arange(len(forms)), numpy.diff(begins)),
        "body": body.points,
        "body_faces": body.faces,
    }


drapes = []
for waist in WAISTS:
    skirt = karinui.Document.create()
    skirt.play(f'body size=jis9ar set="waist_girth={waist}cm"\nset spacing=40mm\n')  # a figure is made once
    for fabric in FABRICS:
        before = skirt.operations
        skirt.perform(f'block kind=skirt length=45cm fabric="{fabric}"')
        report = skirt.settle()
        name = f"drape_{len(drapes):04}.npz"
        numpy.savez_compressed(out / name, **arrays_of(skirt))
        drapes.append({"file": name, "fabric": fabric, "waist_cm": waist, "settled": report["settled"],
                       "strain_mean": report["strain"]["mean"], "pieces": [piece.name for piece in skirt.pieces()],
                       "drape_hash": skirt.drape_hash})
        while skirt.operations > before:
            skirt.undo()
(out / "manifest.json").write_text(json.dumps({"karinui": karinui.__version__, "unit": "m", "drapes": drapes}, indent=1) + "\n")

# What a learner reads.
for drape in json.loads((out / "manifest.json").read_text())["drapes"]:
    with numpy.load(out / drape["file"]) as arrays:
        low = arrays["space"][:, 1].min()
        print(f"{drape['file']}: {drape['fabric']}, waist {drape['waist_cm']} cm, {len(arrays['space'])} places, hem {100 * low:.1f} cm above the floor")
        assert arrays["faces"].max() < len(arrays["space"]) == len(arrays["flat"]) == len(arrays["piece"])

"""The same skirt on the built-in sizes: the ease at the hip, as a plot.

python3 ease_plot.py OUT_FOLDER
"""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

import karinui

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
sizes, body, ease = ["jis9ar", "eu38"], [], []
for size in sizes:
    with karinui.Document.create(threads=2) as skirt:
        skirt.play(f"body size={size}\nset spacing=40mm\nblock kind=skirt length=45cm\n")
        skirt.settle()
        hip = skirt.fit()["girths"]["hip"]
        body.append(100 * hip["body_m"])
        ease.append(100 * hip["ease_m"])
figure, axes = pyplot.subplots(figsize=(5, 4))
axes.bar([f"{size}\n{girth:.0f} cm" for size, girth in zip(sizes, body)], ease)
axes.set_ylabel("ease at the hip, cm")
figure.savefig(out / "ease.png", dpi=100)
print({size: round(cm, 1) for size, cm in zip(sizes, ease)})

"""A skirt in five sizes, each made to its figure: how much cloth it takes at 110, 140 and 150 cm, as a table.

python3 cloth_by_size.py OUT_FOLDER

The folder gets the table, cloth.csv, and a lay plan of each size on cloth of 140 cm.
"""
import csv
import pathlib
import sys

import karinui

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
out.mkdir(parents=True, exist_ok=True)
FIGURES = {"34": (64, 90), "36": (68, 94), "38": (72, 97), "40": (76, 100), "44": (84, 108)}  # waist and hip, cm
WIDTHS = (1.1, 1.4, 1.5)  # of the cloth, metres

rows = []
for size, (waist, hip) in FIGURES.items():
    with karinui.Document.create() as skirt:
        skirt.perform(f'body sex=female set="height=168cm; waist_girth={waist}cm; hip_girth={hip}cm"')
        skirt.perform("block kind=skirt length=60cm fabric=denim")
        skirt.perform('hem edges="skirt_front.hem* skirt_back.hem*" width=4cm under=1cm')
        skirt.perform('band name=waistband of="skirt_front.waist* skirt_back.waist*" depth=4cm fabric=denim')
        row = {"size": size, "waist_cm": waist, "hip_cm": hip}
        for width in WIDTHS:
            [lay] = skirt.layout(width=width)  # one for each fabric
            row[f"on_{100 * width:.0f}_cm"] = f"{lay['length_m']:.2f} m"
            row[f"used_{100 * width:.0f}"] = f"{100 * lay['use']:.0f} %"
        skirt.layout(width=1.4, path=out / f"lay_{size}.pdf")
        rows.append(row)
with (out / "cloth.csv").open("w", newline="", encoding="utf-8") as table:
    writer = csv.DictWriter(table, rows[0].keys())
    writer.writeheader()
    writer.writerows(rows)
print("  ".join(f"{name:>11}" for name in rows[0]))
for row in rows:
    print("  ".join(f"{value:>11}" for value in row.values()))

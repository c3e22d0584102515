"""A skirt for each person of a table, made to her measures: a pattern to print for each, and a table of how it fits.

python3 made_to_measure.py OUT_FOLDER [PEOPLE.csv]

The table is CSV, one person a row; `name`, `sex`, and measures with their unit: waist_girth_cm. A measure that is left empty follows from the others.
"""
import csv
import pathlib
import re
import sys

import karinui

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
out.mkdir(parents=True, exist_ok=True)
people = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).with_name("people.csv"))
UNITS = {"cm": "cm", "mm": "mm", "in": "in"}


def body_of(person: dict[str, str]) -> str:
    """The operation that takes a figure of these measures."""
    measures = []
    for column, value in person.items():
        measure, _, unit = column.rpartition("_")
        if unit in UNITS and value:
            measures.append(f"{measure}={value}{UNITS[unit]}")
    sex = {"m": "male", "c": "child"}.get(person.get("sex", "").lower()[:1], "female")
    return f'body sex={sex} set="{"; ".join(measures)}"'


rows = []
with people.open(newline="", encoding="utf-8") as table:
    for number, person in enumerate(csv.DictReader(table), 1):
        row = {"name": person["name"], "said": "", "hip_ease_cm": "", "strain_percent": "", "pattern": ""}
        rows.append(row)
        with karinui.Document.create() as skirt:
            try:
                skirt.perform(body_of(person))
                skirt.perform("set spacing=40mm")  # between the threads; 10 mm for the real thing
                skirt.perform("block kind=skirt length=50cm")
                report = skirt.settle()
            except karinui.Error as why:  # measures that quarrel, for instance; the others have their skirts
                row["said"] = str(why)
                continue
            row["said"] = report["why"]
            row["strain_percent"] = round(100 * report["strain"]["p99"], 1)
            if hip := skirt.fit()["girths"].get("hip"):
                row["hip_ease_cm"] = round(100 * hip["ease_m"], 1)
            row["pattern"] = f"{number:02}_{re.sub('[^0-9A-Za-z]+', '_', person['name'])}.pdf"
            skirt.export(out / row["pattern"])
with (out / "fitting.csv").open("w", newline="", encoding="utf-8") as table:
    writer = csv.DictWriter(table, rows[0].keys())
    writer.writeheader()
    writer.writerows(rows)
for row in rows:
    print(f"{row['name']}: {row['said']} {row['pattern']}")

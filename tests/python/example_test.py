"""example_test.py EXAMPLE: runs it into a folder of its own. Exit status 77: what it imports is not installed."""
import ast
import csv
import importlib.util
import pathlib
import runpy
import sys
import tempfile

MADE = {  # what is left in the folder
    "first_garment": {"*.pdf": 1, "*.svg": 1, "*.glb": 1},
    "made_to_measure": {"*.pdf": 3, "fitting.csv": 1},
    "cloth_by_size": {"cloth.csv": 1, "lay_*.pdf": 5},
    "parameter_study": {"*.png": 1},
    "drape_dataset": {"*.npz": 6, "manifest.json": 1},
}
example = pathlib.Path(sys.argv[1])
for node in ast.parse(example.read_text()).body:
    for name in [n.name.split(".")[0] for n in node.names] if isinstance(node, ast.Import) else []:
        if importlib.util.find_spec(name) is None:
            print(f"SKIPPED: python3-{name} is not installed")
            sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    folder = str(pathlib.Path(folder) / "not" / "there")
    sys.argv = [str(example), folder]
    runpy.run_path(str(example), run_name="__main__")
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)  # one of them makes nothing
    for made in pathlib.Path(folder).iterdir():
        assert made.stat().st_size > 200, made
    for pattern, count in MADE.get(example.stem, {}).items():
        assert len(list(pathlib.Path(folder).glob(pattern))) == count, pattern
    if example.stem == "made_to_measure":
        with (pathlib.Path(folder) / "fitting.csv").open(newline="", encoding="utf-8") as table:
            said = {row["name"]: row["said"] for row in csv.DictReader(table)}
        assert said["Hana"] == "At rest." and "do not go together" in said["Rin"], said

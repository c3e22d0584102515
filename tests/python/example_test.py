"""example_test.py EXAMPLE: runs it into a folder of its own. Exit status 77: what it imports is not installed."""
import ast
import importlib.util
import pathlib
import runpy
import sys
import tempfile

example = pathlib.Path(sys.argv[1])
for node in ast.parse(example.read_text()).body:
    for name in [n.name.split(".")[0] for n in node.names] if isinstance(node, ast.Import) else []:
        if importlib.util.find_spec(name) is None:
            print(f"SKIPPED: python3-{name} is not installed")
            sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    sys.argv = [str(example), folder]
    runpy.run_path(str(example), run_name="__main__")
    for made in pathlib.Path(folder).iterdir():
        assert made.stat().st_size > 500, made

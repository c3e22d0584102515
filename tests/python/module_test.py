"""The module for Python. Exit status 77: numpy is missing, and so nothing of arrays was tested."""
import ast
import gc
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import karinui

PANEL = 'piece name=front outline="M 0 0; hem L 400 0; side L 400 500; top L 0 500; centre L 0 0"'
try:
    import numpy
except ImportError:
    numpy = None


class Documents(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_performs_undoes_and_keeps(self):
        path = self.folder / "coat.karinui"
        with karinui.Document.create(path) as coat:
            empty = coat.hash
            self.assertEqual(coat.perform(PANEL)["operations"], 1)
            made = coat.hash
            self.assertEqual(coat.undo()["hash"], empty)
            self.assertEqual(coat.redo()["hash"], made)
            coat.amend(1, PANEL.replace("name=front", "name=back"))
            self.assertEqual((coat.pieces()[0].name, coat.operations), ("back", 1))
            coat.amend(1, PANEL)
            self.assertEqual(coat.hash, made)
            self.assertEqual(coat.play("notch edge=front.hem at=0.5\n# a comment\nset ease=1cm\n"), 2)
            last, log = coat.hash, coat.log()
        again = karinui.Document.open(path, reading=True)
        self.assertEqual((again.hash, again.log(), again.operations, again.remarks), (last, log, 3, []))
        piece = again.pieces()[0]
        self.assertEqual(piece.name, "front")
        self.assertAlmostEqual(piece.area, 0.2, 12)
        self.assertEqual(list(piece.edges), ["hem", "side", "top", "centre"])
        self.assertAlmostEqual(piece.edges["side"], 0.5, 12)
        self.assertIsNone(piece.form)
        for ending in ("svg", "pdf", "json", "ops", "dxf"):
            self.assertEqual(again.export(self.folder / f"x.{ending}"), (self.folder / f"x.{ending}").stat().st_size)
        again.close()
        karinui.load(karinui.dump(path), self.folder / "copy.karinui")
        self.assertEqual(karinui.Document.open(self.folder / "copy.karinui").hash, last)

    def test_refusals_are_sentences(self):
        coat = karinui.Document.create()
        for call, kind, words in (
            (lambda: coat.perform("knit piece=front"), "bad_input", "knit"),
            (lambda: coat.perform("remove piece=front"), "refused", "front"),
            (lambda: coat.undo(), "refused", "nothing to undo"),
            (lambda: coat.amend(1, PANEL), "refused", "no step 1"),
            (lambda: coat.measure(), "refused", "no body yet"),
            (lambda: coat.motion(["T"]), "refused", "no body yet"),
            (lambda: coat.fit_over(["jis9ar"]), "refused", "nothing to fit"),
            (lambda: coat.fit_over([{"name": "Anna", "sex": "cat"}]), "bad_input", "is no figure"),
            (lambda: coat.fit_over([{"bust": 0.9, "bogus": 1.0}]), "not_found", "bogus"),
            (lambda: coat.fit_over(self.folder / "none.csv"), "not_found", "none.csv"),
            (lambda: coat.play("set ease=1cm\nknit\n"), "bad_input", "Line 2"),
            (lambda: karinui.Document.open(self.folder / "none.karinui"), "not_found", "There is no file"),
            (lambda: karinui.load("nonsense", self.folder / "x.karinui"), "bad_input", "not a dump"),
        ):
            with self.assertRaises(karinui.Error) as raised:
                call()
            self.assertIn(words, str(raised.exception))
            self.assertEqual(raised.exception.kind, kind)
        with self.assertRaises(TypeError):
            coat.perform(7)
        self.assertEqual(coat.operations, 0)

    def test_a_figure_is_measured_in_its_own_pose(self):
        figure = karinui.Document.create()
        figure.perform("body size=eu38")
        standing = figure.measure()
        self.assertAlmostEqual(standing["hip_girth"], 0.97, 2)
        figure.perform("pose name=seated")
        self.assertEqual(figure.measure(), standing)

    def test_a_closed_document_says_so(self):
        path = self.folder / "coat.karinui"
        with karinui.Document.create(path) as coat:
            coat.perform(PANEL)
        coat.close()  # again: nothing
        for use in (
            lambda: coat.perform(PANEL), lambda: coat.play("set ease=1cm"), lambda: coat.amend(1, PANEL), coat.undo,
            coat.redo, coat.settle, coat.check, coat.fit, lambda: coat.motion(["T"]),
            lambda: coat.fit_over(["jis9ar"]), coat.measure, lambda: coat.export(self.folder / "x.svg"),
            coat.layout, lambda: coat.read_pattern(self.folder / "x.svg"),
            lambda: coat.picture(self.folder / "x.png"), coat.strain, coat.pressure,
            lambda: coat.share(self.folder / "x.karinui"), coat.pieces, coat.body, coat.log, lambda: coat.path,
            lambda: coat.hash, lambda: coat.drape_hash, lambda: coat.operations, lambda: coat.remarks,
            lambda: coat.notes, coat.__enter__,
        ):
            with self.assertRaises(karinui.Error) as raised:
                use()
            self.assertIn("is closed", str(raised.exception))
            self.assertEqual(raised.exception.kind, "refused")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["coat.karinui"])
        self.assertEqual(karinui.Document.open(path, reading=True).operations, 1)

    def test_paper_is_asked_for_as_by_command(self):
        with karinui.Document.create(self.folder / "coat.karinui") as coat:
            coat.perform(PANEL)

            def written(name, **asked):
                coat.export(self.folder / name, **asked)
                return (self.folder / name).read_bytes()

            pages = {paper: len(written(f"{paper}.pdf", paper=paper)) for paper in ("sheet", "a4", "a0")}
            self.assertEqual(len(set(pages.values())), 3, pages)
            self.assertEqual(written("x.pdf"), (self.folder / "a4.pdf").read_bytes())
            self.assertNotEqual(written("x.pdf", overlap=0.02), (self.folder / "a4.pdf").read_bytes())
            plain, wide = written("x.svg", allowance=0), written("y.svg", allowance=0.025)
            self.assertIn(b'data-allowance="25"', wide)
            self.assertNotIn(b'data-allowance="25"', plain)
            self.assertIn(b"May 1st", written("x.svg", date="May 1st"))
            self.assertNotEqual(written("a.dxf"), written("b.dxf", format="dxf-astm"))
            for asked, words in (
                ({"paper": "a5"}, "no paper “a5”"), ({"overlap": 10}, "0.005 to 0.03"),
                ({"allowance": 10}, "0 to 0.1"), ({"format": "dxf-astm"}, "no format of"),
            ):
                with self.assertRaises(karinui.Error) as raised:
                    coat.export(self.folder / "z.pdf", **asked)
                self.assertIn(words, str(raised.exception))
            for asked in ({"paper": "a4"}, {"overlap": 0.01}, {"date": "today"}, {"nest": True}):
                with self.assertRaises(karinui.Error) as raised:
                    coat.export(self.folder / "z.json", **asked)
                self.assertIn(f"{next(iter(asked))} says nothing of “z.json”", str(raised.exception))
            self.assertFalse((self.folder / "z.pdf").exists() or (self.folder / "z.json").exists())

    def test_paper_speaks_the_language_spoken_here(self):
        script = f"import karinui; d = karinui.Document.create(); d.perform({PANEL!r}); d.export({str(self.folder / 'x.svg')!r})"
        words = {}
        for language in ("C.UTF-8", "ja_JP.UTF-8"):
            speaking = {**os.environ, "LC_ALL": language, "PYTHONPATH": str(pathlib.Path(karinui.__file__).parent)}
            subprocess.run([sys.executable, "-c", script], env=speaking, check=True)
            words[language] = (self.folder / "x.svg").read_text(encoding="utf-8")
        japanese = [any("぀" <= c <= "鿿" for c in text) for text in words.values()]
        self.assertEqual(japanese, [False, True])

    def test_reads_patterns_and_lays_them(self):
        with karinui.Document.create() as coat:
            coat.play(PANEL + " fabric=denim\nduplicate piece=front name=back by=0,0,-40cm\n")
            coat.export(self.folder / "coat.svg")
            coat.export(self.folder / "coat.dxf")
            lay = coat.layout(width=1.4, tries=50)
            self.assertEqual([(one["fabric"], one["width_m"], one["pieces"]) for one in lay], [("denim", 1.4, 2)])
            self.assertTrue(0.4 < lay[0]["length_m"] < 0.7 and 0.4 < lay[0]["use"] <= 1, lay)
            self.assertEqual(coat.layout(fabric="denim", width=1.4, tries=50, path=self.folder / "lay.pdf"), lay)
            self.assertEqual((self.folder / "lay.pdf").read_bytes()[:5], b"%PDF-")
            for call, words in (
                (lambda: coat.layout(width=0.2), "Take wider cloth"),
                (lambda: coat.layout(path=self.folder / "lay.png"), ".pdf, .svg, .dxf, .plt"),
                (lambda: coat.read_pattern(self.folder / "none.dxf"), "There is no file"),
                (lambda: coat.read_pattern(self.folder / "lay.pdf"), ".dxf"),
                (lambda: coat.read_pattern(self.folder / "coat.svg", size="40"), "one size only"),
            ):
                before = coat.hash
                with self.assertRaises(karinui.Error) as raised:
                    call()
                self.assertIn(words, str(raised.exception))
                self.assertEqual(coat.hash, before)
        drawing = self.folder / "units.svg"
        drawing.write_text('<svg viewBox="0 0 900 900"><rect width="500" height="400"/></svg>', encoding="utf-16")
        with karinui.Document.create() as read:
            with self.assertRaisesRegex(karinui.Error, "mm, cm, m, in, pt"):
                read.read_pattern(drawing, unit="ell")
            read.read_pattern(drawing, unit="mm")
            self.assertEqual([round(p.area, 6) for p in read.pieces()], [0.2])
        (self.folder / "bytes.dxf").write_bytes(b"\xff\xfc0\nSECTION\n")
        with karinui.Document.create() as read, self.assertRaisesRegex(karinui.Error, "no DXF text"):
            read.read_pattern(self.folder / "bytes.dxf")
        for file in ("coat.svg", "coat.dxf"):
            with karinui.Document.create() as read:
                self.assertEqual(read.read_pattern(self.folder / file), read.operations)
                self.assertEqual([round(p.area, 4) for p in read.pieces()], [0.2, 0.2])

    def test_levels_are_called_as_in_other_answers(self):
        with karinui.Document.create(threads=1) as shirt:
            shirt.play("body size=eu38\nset spacing=50mm\nblock kind=bodice\n")
            self.assertIn("under_bust", shirt.fit()["girths"])

    def test_pictures(self):
        with karinui.Document.create() as coat:
            for call, words in (
                (lambda: coat.picture(self.folder / "x.png"), "nothing to see"),
                (lambda: coat.picture(self.folder / "x.png", table=True), "no piece yet"),
                (lambda: coat.picture(self.folder / "x.jpg"), ".png"),
                (lambda: coat.picture(self.folder / "x.png", view="above"), "above"),
                (lambda: coat.picture(self.folder / "x.png", turns=1), "2 to 36"),
                (lambda: coat.picture(self.folder / "x.png", map="heat"), "say strain, pressure, or none"),
                (lambda: coat.picture(self.folder / "x.png", map="pressure"), "no figure to be pressed on"),
            ):
                with self.assertRaises(karinui.Error) as raised:
                    call()
                self.assertIn(words, str(raised.exception))
            self.assertEqual(list(self.folder.iterdir()), [])
            coat.perform(PANEL)
            drawn = {}
            for name, how in (
                ("front", {}), ("back", {"view": "back"}), ("table", {"table": True}), ("turns", {"turns": 2}),
            ):
                size = coat.picture(self.folder / f"{name}.png", size="120x160", **how)
                data = drawn[name] = (self.folder / f"{name}.png").read_bytes()
                self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
                self.assertEqual(size, (int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")))
                if name != "turns":
                    self.assertEqual(size, (120, 160))
            self.assertNotEqual(drawn["front"], drawn["table"])

    def test_a_map_of_pressure_and_the_force_of_a_pull(self):
        with karinui.Document.create(threads=1) as band:
            band.play(
                'body size=eu38\nset spacing=50mm\n'
                'piece name=band outline="M 0 0; hem L 1100 0; right L 1100 300; top L 0 300; left L 0 0"\n'
                'place piece=band at="torso:hip@0" ease=3cm\nsew a=band.left b=band.right\npin edge=band.top\n')
            with self.assertRaises(karinui.Error) as raised:
                band.picture(self.folder / "x.png", map="pressure")
            self.assertIn("no pressure to show yet", str(raised.exception))
            self.assertEqual(list(self.folder.iterdir()), [])
            self.assertIn("settled", band.perform("drape"))
            drawn = set()
            for name in ("none", "strain", "pressure"):
                self.assertEqual(band.picture(self.folder / f"{name}.png", map=name, size="120x160"), (120, 160))
                drawn.add((self.folder / f"{name}.png").read_bytes())
            self.assertEqual(len(drawn), 3)
            pulled = band.perform("pull piece=band at=55cm,5cm by=0,0,1cm seconds=0.1")
            self.assertGreater(pulled["max_force_n"], 0.001)
            self.assertIn("settled", pulled)
            self.assertNotIn("max_force_n", band.perform("set ease=1cm"))

    def test_threads_work_while_a_document_works(self):
        coat = karinui.Document.create(threads=1)
        coat.play("body size=jis9ar\nset spacing=15mm\n" + PANEL.replace("M 0", "M 0") + " pose=0,0.6,0.5\npin edge=front.top\n")
        ticks, stop = [], threading.Event()

        def tick():
            while not stop.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        clock = threading.Thread(target=tick)
        clock.start()
        before = len(ticks)
        coat.settle()  # without progress, in which Python would take turns
        during = len(ticks) - before
        stop.set()
        clock.join()
        self.assertGreater(during, 20)
        told = []
        coat.settle(again=True, progress=lambda fraction, doing: told.append((fraction, doing)))
        self.assertTrue(told and all(0 <= fraction <= 1 for fraction, _ in told))
        # What progress raises stops the work, which changes nothing.
        mark = coat.drape_hash

        def fail(fraction, doing):
            raise KeyError("enough")

        with self.assertRaises(KeyError):
            coat.settle(again=True, progress=fail)
        self.assertEqual(coat.drape_hash, mark)
        # Two threads ask the same document.
        panels = [threading.Thread(target=lambda: [coat.perform("move piece=front by=0,0,1mm") for _ in range(20)])
                  for _ in range(2)]
        count = coat.operations
        for thread in panels:
            thread.start()
        for thread in panels:
            thread.join()
        self.assertEqual(coat.operations, count + 40)

    @unittest.skipIf(numpy is None, "python3-numpy is not installed")
    def test_arrays_look_into_the_document(self):
        coat = karinui.Document.create(threads=1)
        coat.play("body size=jis9ar\nset spacing=30mm\n" + PANEL + " pose=0,0.6,0.5\npin edge=front.top\n")
        coat.settle()
        form = coat.pieces()[0].form
        flat, space, faces = form.flat, form.space, form.faces
        self.assertEqual((flat.shape[1], space.shape[1], faces.shape[1]), (2, 3, 3))
        self.assertEqual(len(flat), len(space))
        self.assertLess(faces.max(), len(flat))
        self.assertFalse(space.flags.owndata)
        self.assertTrue(numpy.shares_memory(space, coat.pieces()[0].form.space))
        with self.assertRaises(ValueError):
            space[0, 0] = 1
        kept = space.copy()
        coat.undo()
        coat.close()
        del coat, form
        gc.collect()
        self.assertTrue((space == kept).all())  # it lives as long as somebody looks
        outline = karinui.Document.create()
        outline.perform(PANEL)
        ring = outline.pieces()[0].outline()
        x, y = ring[:, 0], ring[:, 1]
        self.assertAlmostEqual(0.5 * float((x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum()), 0.2, 9)

    def test_fit_in_motion_and_over_figures(self):
        coat = karinui.Document.create(threads=1)
        coat.play("body size=jis9ar\nset spacing=30mm\n" + PANEL + " pose=0,0.6,0.5\npin edge=front.top\n")
        coat.settle()
        mark = (coat.log(), coat.drape_hash)
        now, moved = coat.motion(["A"])
        self.assertEqual((now["pose"], moved["pose"], moved["settled"]), ("", "A", True))
        self.assertEqual(set(moved["strain"]), {"mean", "p99", "max"})
        self.assertIsInstance(moved["slid"], dict)
        file = self.folder / "moving.glb"
        self.assertEqual(coat.export(file, poses=["arms_down", "A"]), file.stat().st_size)
        self.assertIn(b'"targetNames"', file.read_bytes())
        with self.assertRaises(karinui.Error) as raised:
            coat.export(self.folder / "moving.obj", poses=["A"])
        self.assertIn("Only a GLB", str(raised.exception))
        (she,) = coat.fit_over(["jis9ar"])
        self.assertEqual((she["name"], she["fits"], she["said"]), ("jis9ar", True, ""))
        self.assertAlmostEqual(she["strain"]["p99"], now["strain"]["p99"], 12)
        self.assertEqual((coat.log(), coat.drape_hash), mark)
        self.assertEqual(coat.check()["fastenings"], [])
        self.assertIs(coat.check()["at_rest"], True)

    @unittest.skipIf(numpy is None, "python3-numpy is not installed")
    def test_strain_and_pressure_by_place(self):
        coat = karinui.Document.create(threads=1)
        with self.assertRaises(karinui.Error) as raised:
            coat.pressure()
        self.assertIn("no body yet", str(raised.exception))
        self.assertEqual(coat.strain(), [])
        coat.play("body size=jis9ar\nset spacing=20mm\nblock kind=skirt length=30cm\n")
        coat.settle()
        pieces = coat.strain()
        self.assertEqual([p["piece"] for p in pieces], [p.name for p in coat.pieces()])
        everywhere = numpy.concatenate([p["strain"] for p in pieces])
        self.assertTrue((everywhere >= 0).all())
        self.assertGreater(everywhere.max(), 0)
        for piece, drawn in zip(pieces, coat.pieces()):
            count = len(piece["strain"])
            self.assertEqual((piece["flat"].shape, piece["space"].shape), ((count, 2), (count, 3)))
            self.assertLess(piece["faces"].max(), count)
            edges = piece["flat"][piece["faces"]]
            turned = (edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0])
            area = abs(turned[0][:, 0] * turned[1][:, 1] - turned[0][:, 1] * turned[1][:, 0]).sum() / 2
            self.assertLess(abs(area / drawn.area - 1), 0.2)  # less what its darts take in
        pressure = coat.pressure()
        self.assertEqual(pressure.shape, (len(coat.body().points),))
        lies = pressure[~numpy.isnan(pressure)]
        self.assertTrue(0 < len(lies) < len(pressure))
        self.assertGreater(lies.max(), 0)
        self.assertTrue((lies >= 0).all())

    def test_the_stubs_name_what_there_is(self):
        stubs = ast.parse((pathlib.Path(karinui.__file__).parent / "karinui.pyi").read_text())
        own = lambda names: {n for n in names if not n.startswith("_")}
        for node in stubs.body:
            if isinstance(node, ast.ClassDef) and node.name != "Error":
                said = own(f.name for f in node.body if isinstance(f, ast.FunctionDef))
                self.assertEqual(said, own(vars(getattr(karinui, node.name))), node.name)
        top = {n.name for n in stubs.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(top, own(vars(karinui)))


if __name__ == "__main__":
    program = unittest.main(exit=False)
    sys.exit(1 if not program.result.wasSuccessful() else 77 if numpy is None else 0)

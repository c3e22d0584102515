"""How tight may a skirt be, in which fabric? The same skirt over its ease and its fabric, each brought to rest, as a plot:
how much the cloth is stretched, how hard it presses, and the ease that is left when it hangs.

python3 parameter_study.py OUT_FOLDER
"""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

import karinui

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
out.mkdir(parents=True, exist_ok=True)
EASES = [0, 2, 4, 6]  # centimetres at the hip
FABRICS = ["denim", "jersey"]


skirt = karinui.Document.create()
skirt.play("body size=jis9ar\nset spacing=15mm\n")  # the figure is made once; coarser cloth presses at single points
figure_only = skirt.operations


def made(ease: float, fabric: str) -> tuple[dict, dict]:
    while skirt.operations > figure_only:
        skirt.undo()
    skirt.perform(f"block kind=skirt length=45cm ease={ease}cm fabric={fabric}")
    return skirt.settle(), skirt.fit()


figure, (stretch, pressure, left) = pyplot.subplots(1, 3, figsize=(10, 3.2), constrained_layout=True)
for fabric in FABRICS:
    settled, fits = zip(*(made(ease, fabric) for ease in EASES))
    stretch.plot(EASES, [100 * report["strain"]["p99"] for report in settled], "o-", label=fabric)
    pressure.plot(EASES, [fit["pressure_mean_pa"] for fit in fits], "o-", label=fabric)
    left.plot(EASES, [100 * fit["girths"]["hip"]["ease_m"] for fit in fits], "o-", label=fabric)
for axes, what in ((stretch, "stretch, %\n(99 of 100 places have less)"), (pressure, "mean pressure on the body, Pa"),
                   (left, "ease at the hip when it hangs, cm")):
    axes.set_title(what, fontsize=10)
    axes.set_xlabel("ease it is drafted with, cm")
    axes.set_ylim(bottom=0)
stretch.legend()
figure.savefig(out / "skirt_ease.png", dpi=110)

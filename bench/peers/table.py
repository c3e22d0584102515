"""What bench/peers/run found, as a table (Markdown) and as a plot (SVG)."""
import math

NAMES = {"w1": "W1, curtain", "w2": "W2, sphere", "w3": "W3, tunic"}
COLOURS = {"Karinui": "#b3123f", "Bullet": "#1f6fb2", "Blender": "#d98200"}
AT_REST = 5  # mm/s


def table(runs):
    lines = ["| scene | program | CPU s | times Karinui's | fastest, mm/s | strain mean / p99 / max, % | clearance, mm | crossings | gap, mm |",
             "|---|---|---|---|---|---|---|---|---|"]
    for run in runs:
        cell = [run["scene"], run["program"], f"{run['cpu_s']:.1f}{'' if run['settled'] else ' (stopped)'}",
                f"{run['times_karinui']:.0f}" if run["program"] != "Karinui" else "1", f"{run['top_speed_mm_s']:.0f}",
                " / ".join(f"{100 * run['strain_' + k]:.3g}" for k in ("mean", "p99", "max")),
                f"{run['clearance_mm']:.1f}" if "clearance_mm" in run else "-", str(run["cloth_cloth_crossings"]),
                f"{run['seam_gap_mm']:.1f}" if run["scene"] == "w3" else "-"]
        lines.append("| " + " | ".join(cell) + " |")
    return "\n".join(lines) + "\n"


def svg(runs, width=300, height=260, edge=50):
    """A panel a scene: processor time across, strain upwards, both by tens. A full dot is at rest by one measure for all: no
    point faster than 5 mm/s in ten frames; a hollow one still moves."""
    scenes = sorted({run["scene"] for run in runs})
    across, up = (0.1, 1000.0), (0.0001, 10.0)  # seconds, percent

    def x(panel, value):
        return edge + panel * width + (width - edge - 10) * math.log(value / across[0]) / math.log(across[1] / across[0])

    def y(value):
        return height - edge - (height - 2 * edge) * math.log(max(value, up[0]) / up[0]) / math.log(up[1] / up[0])

    def text(px, py, words, anchor="middle", colour="#333", size=11):
        return f'<text x="{px:.0f}" y="{py:.0f}" text-anchor="{anchor}" fill="{colour}" font-size="{size}">{words}</text>'

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width * len(scenes) + 10} {height + 6}" font-family="sans-serif">',
           '<rect width="100%" height="100%" fill="white"/>']
    for panel, scene in enumerate(scenes):
        out.append(text(x(panel, 10), 20, NAMES[scene], size=13))
        for k in range(-1, 4):
            px = x(panel, 10.0 ** k)
            out.append(f'<path d="M{px:.1f} {y(up[0]):.1f}V{y(up[1]):.1f}" stroke="#ddd"/>' + text(px, height - edge + 15, f"{10.0 ** k:g}"))
        for k in range(-4, 2):
            py = y(10.0 ** k)
            out.append(f'<path d="M{x(panel, across[0]):.1f} {py:.1f}H{x(panel, across[1]):.1f}" stroke="#ddd"/>')
            out.append(text(x(panel, across[0]) - 4, py + 4, f"{10.0 ** k:g}", "end"))
        out.append(text(x(panel, 10), height - edge + 32, "CPU seconds"))
        if panel == 0:
            out.append(f'<text transform="translate(12 {height / 2:.0f}) rotate(-90)" text-anchor="middle" fill="#333" font-size="11">mean strain, %</text>')
        for run in runs:
            if run["scene"] != scene:
                continue
            colour = COLOURS[run["program"]]
            px, py = x(panel, run["cpu_s"]), y(100 * run["strain_mean"])
            rests = run["top_speed_mm_s"] < AT_REST
            out.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="5" stroke="{colour}" stroke-width="2" fill="{colour if rests else "white"}"/>')
            lines = [run["program"], "at rest" if rests else f"{run['top_speed_mm_s']:.0f} mm/s"]
            lines += [f"{run['cloth_cloth_crossings']} crossings"] if run["cloth_cloth_crossings"] else []
            lines += [f"{run['penetration_mm']:.0f} mm in the body"] if run["penetration_mm"] > 0.05 else []
            lines += [f"gap {run['seam_gap_mm']:.1f} mm"] if run["seam_gap_mm"] > 0.5 else []
            first = py - 10 - 11 * (len(lines) - 1) if run["program"] == "Bullet" else py + 17  # two may lie close
            for k, line in enumerate(lines):
                out.append(text(px, first + 11 * k, line, colour=colour, size=11 if k == 0 else 9))
    out.append("</svg>")
    return "\n".join(out) + "\n"

"""programs_sockets_test.py WATCH STUDIO ROOM STUB_RUNTIME MODULE_FOLDER: nothing leaves the machine by the programs with a window or a headset, nor by
the module for Python: each is run with every socket written down (watched_sockets.cpp), as network_test.cpp runs the command. What is "" was not
built. Devices are asked for on this machine: sockets of the file system, and the loopback interface. With KARINUI_LONG the studio works a garment by itself (--self-check)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

watch, studio, room, runtime, module = sys.argv[1:]
BAND = """body size=jis9ar
set spacing=50mm
piece name=band outline="M 0 0; low L 900 0; right L 900 150; top L 0 150; left L 0 0"
place piece=band at="torso:waist@0" ease=2cm
sew a=band.left b=band.right
"""
MODULE = """
import karinui, sys
with karinui.Document.create("d.karinui", threads=2) as document:
    document.play(open("band.ops").read())
    document.settle()
    document.fit(), document.check(), document.measure(), document.pieces(), document.body()
    for ending in ("pdf", "svg", "glb", "dxf"):
        document.export("d." + ending)
    document.share("shared.karinui")
karinui.load(karinui.dump("d.karinui"), "loaded.karinui")
"""
folder = tempfile.TemporaryDirectory()
here = pathlib.Path(folder.name)
(here / "band.ops").write_text(BAND)
faults = []


def sockets_of(what: str, command: list[str], settings: dict[str, str] | None = None, fails: bool = False) -> list[str]:
    log = here / "sockets"
    log.unlink(missing_ok=True)
    environment = {**os.environ, "HOME": str(here), "LC_ALL": "C", "LD_PRELOAD": watch, "KARINUI_SOCKETS": str(log), **(settings or {})}
    environment.pop("XDG_CONFIG_HOME", None)
    done = subprocess.run(command, env=environment, cwd=here, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    if done.returncode != 0 and not fails:
        faults.append(f"{what} ended with {done.returncode}: {done.stdout[-2000:]}")
    lines = log.read_text().splitlines() if log.exists() else []
    print(f"{what}: {', '.join(sorted(set(lines))) or 'no socket'}")
    return lines


def expect_only(what: str, lines: list[str], allowed: str) -> None:
    faults.extend(f"{what}: {line}" for line in sorted(set(lines)) if not re.fullmatch(allowed, line))


def expect_watched(what: str, lines: list[str]) -> None:
    if not any(line.startswith("connect unix") for line in lines):
        faults.append(f"{what} is not watched: it speaks to its display by a socket")


LOCAL = r"socket (unix|inet|other)|connect unix .*|bind unix .*|(connect|bind) inet (127\.0\.0\.1|::1)"
# The watch itself: what is not allowed is seen.
CALLS = "import socket; socket.socket(type=socket.SOCK_DGRAM).connect(('192.0.2.1', 9))"
seen = sockets_of("somebody who calls home", [sys.executable, "-c", CALLS], fails=True)
if "connect inet 192.0.2.1" not in seen:
    faults.append("the watch does not see who calls home")

if module:
    lines = sockets_of("import karinui", [sys.executable, "-c", MODULE], {"PYTHONPATH": module})
    expect_only("import karinui", lines, r"nothing")
display = None
if (studio or room) and shutil.which("Xvfb"):
    number, said = os.pipe()
    display = subprocess.Popen(["Xvfb", "-displayfd", str(said), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"], pass_fds=[said], stderr=subprocess.DEVNULL)
    os.close(said)
    screen = {"DISPLAY": ":" + os.read(number, 16).decode().strip(), "WAYLAND_DISPLAY": "", "LP_NUM_THREADS": "2"}
    try:
        if studio:
            work = ["--self-check"] if os.environ.get("KARINUI_LONG") else ["--picture", str(here / "window.png"), "--threads", "1"]
            lines = sockets_of("karinui-studio", [studio, *work, "band.ops"], screen)
            expect_only("karinui-studio", lines, LOCAL)
            expect_watched("karinui-studio", lines)
        if room:
            lines = sockets_of("karinui-room", [room, "--headless-test", str(here / "out"), "--threads", "1", "--share", "window", "--new", "jis9ar"],
                               {**screen, "XR_RUNTIME_JSON": runtime, "KARINUI_STUB_LOG": str(here)})
            expect_only("karinui-room", lines, LOCAL)
            expect_watched("karinui-room", lines)
    finally:
        display.terminate()
        display.wait()
else:
    print("Left out: studio and room (Xvfb).")
for fault in faults:
    print(fault, file=sys.stderr)
sys.exit(1 if faults else 0)

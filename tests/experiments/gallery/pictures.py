#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the gallery's pictures of runs: three crack modes at one instant, four struck things of glass, and findings.

    tests/experiments/gallery/pictures.py SUNDER [modes] [struck] [check] [--out docs/images]

Five minutes of one core. Needs Debian's python3-pil, python3-numpy, python3-meshio, pngquant and
fonts-dejavu-core."""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import textwrap

from PIL import Image, ImageDraw, ImageFont

TREE = pathlib.Path(__file__).resolve().parents[3]
FONTS = pathlib.Path("/usr/share/fonts/truetype/dejavu")
sys.path.insert(0, str(TREE / "tests/experiments/bending"))

MODES = {  # mode: words of its label, settings
    "paper": ("dust along each crack", []),
    "object": ("few large pieces", ["output.crack_surface=smooth"]),
    "cohesive": ("cracks take energy", ["output.crack_surface=smooth", "bodies.0.material.fracture_energy=11"]),
}
STRUCK = {  # first word of a case's name: label, camera
    "pane": ("pane of 6 mm, ball at 10 m/s", "0.4,-0.25,0.32", "0.155,0.135,-0.01", 41),
    "cup": ("cup, fell 1 m", "0.17,-0.22,0.14", "0.005,-0.037,0.032", 37),
    "beam": ("beam on two edges, ball at 5 m/s", "0.3,-0.33,0.19", "0.222,0.02,0", 49),
    "tile": ("tile, fell 1 m", "0.29,-0.2,0.2", "0.105,0.085,0.012", 38),
}


def sunder(program, *words):
    subprocess.run([str(program), *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def font(size, name="DejaVuSans.ttf"):
    return ImageFont.truetype(str(FONTS / name), size)


def labelled(path, label, size):
    """A picture with its label on a band below it."""
    drawn = Image.open(path).convert("RGB")
    whole = Image.new("RGB", (drawn.width, drawn.height + 2 * size), "white")
    whole.paste(drawn)
    ImageDraw.Draw(whole).text((drawn.width / 2, drawn.height + size), label, fill="#222222", anchor="mm",
                               font=font(size))
    return whole


def lay_out(pictures, columns, path):
    """Pictures of one size in rows, 8 pixels apart, in 256 colours."""
    width, height = pictures[0].width + 8, pictures[0].height + 8
    rows = -(-len(pictures) // columns)
    whole = Image.new("RGB", (columns * width - 8, rows * height - 8), "white")
    for k, picture in enumerate(pictures):
        whole.paste(picture, (k % columns * width, k // columns * height))
    whole.save(path)
    subprocess.run(["pngquant", "--force", "--speed", "1", "--output", str(path), "256", str(path)], check=True)


def modes(program, folder, out):
    """The paper's bunny 2 ms after its first crack, in each mode."""
    pictures = []
    for mode, (words, settings) in MODES.items():
        sets = [word for setting in settings for word in ("--set", setting)]
        sunder(program, "run", TREE / "meshes/scenes/paper/bunny.json", "-o", folder / mode, "--quiet",
               "--frame-interval", "1e-3", "--set", f"fracture.crack={mode}", "--set", "duration=0.022", *sets)
        sunder(program, "render", folder / mode, folder / "one.png", "--quiet", "--size", "400,400", "--eye",
               "0.25,-0.34,0.24", "--target", "0.004,0,0.088", "--fov", 29)
        pieces = json.loads((folder / mode / "report.json").read_text())["components"]
        pictures.append(labelled(folder / "one.png", f"{mode}: {words}, {pieces} pieces", 16))
    lay_out(pictures, 3, out / "three_modes_bunny.png")


def struck(program, folder, out):
    """Things of glass 1 ms after they were struck, order 2, pieces moved apart."""
    from order_tools import write_mesh
    from thin_things import GLASS, struck_cases

    pictures = []
    for name, mesh, scene, placed in struck_cases(1):
        thing = name.split()[0]
        if thing not in STRUCK or (thing == "pane" and "at 10 m/s" not in name):
            continue
        write_mesh(folder / "body.mesh", *mesh)
        body = dict(mesh="body.mesh", order=2, material=GLASS, **placed)
        (folder / "scene.json").write_text(json.dumps(dict(scene, bodies=[body], fracture={"crack": "object"})))
        sunder(program, "run", folder / "scene.json", "-o", folder / thing, "--quiet", "--frames", 2)
        label, eye, target, angle = STRUCK[thing]
        sunder(program, "render", folder / thing, folder / "one.png", "--quiet", "--size", "560,400", "--explode",
               0.15 if thing == "beam" else 0.25, "--eye", eye, "--target", target, "--fov", angle)
        pictures.append(labelled(folder / "one.png", label, 16))
    lay_out(pictures, 2, out / "struck.png")


def check(program, folder, out):
    """The answer of `sunder check` about the faulty mesh of the tutorial, as a terminal of 100 columns shows it."""
    (folder / "faulty.mesh").write_text(
        "MeshVersionFormatted 2\nDimension 3\nVertices 7\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1.00000001 0 0 0\n"
        "1 1 1 0\n5 5 5 0\nTetrahedra 3\n1 2 3 4 1\n5 3 4 6 1\n1 3 2 4 1\nEnd\n")
    printed = subprocess.run([str(program), "check", "faulty.mesh"], cwd=folder, capture_output=True, text=True)
    lines = ["$ sunder check faulty.mesh"]
    for line in (printed.stdout + printed.stderr).splitlines():
        lines += textwrap.wrap(line, 100, subsequent_indent="    ") or [""]
    face, height = font(15, "DejaVuSansMono.ttf"), 21
    shot = Image.new("RGB", (int(face.getlength(100 * "m")) + 40, height * len(lines) + 32), "#1d2126")
    pen = ImageDraw.Draw(shot)
    colours = {": error:": "#ff7b72", ": warning:": "#e3b341", ": note:": "#79c0ff", "$ ": "#7ee787",
               "not valid": "#ff7b72"}
    for k, line in enumerate(lines):
        at, word, colour = next(((line.index(w), w, c) for w, c in colours.items() if w in line), (0, "", "#000"))
        for start, part, fill in ((0, line[:at], "#d0d7de"), (at, word, colour),
                                  (at + len(word), line[at + len(word):], "#d0d7de")):
            pen.text((20 + face.getlength("m" * start), 16 + height * k), part, fill=fill, font=face)
    shot.save(out / "check.png", optimize=True)


PARTS = {"modes": modes, "struck": struck, "check": check}


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("sunder", type=lambda p: pathlib.Path(p).resolve())
    words.add_argument("parts", nargs="*", default=list(PARTS))
    words.add_argument("--out", type=lambda p: pathlib.Path(p).resolve(), default=TREE / "docs/images")
    given = words.parse_args()
    for part in given.parts:
        with tempfile.TemporaryDirectory() as folder:
            PARTS[part](given.sunder, pathlib.Path(folder), given.out)


if __name__ == "__main__":
    main()

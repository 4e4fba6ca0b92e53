# SPDX-License-Identifier: MIT
"""Figures 3 to 5 as drawings of what `sunder split` says, for make.sh.

    python3 splits.py SUNDER MESHES FOLDER

Grey faces are split; red ones are those whose three vertices split with them, so that the oracle
expects a new component; dots are the vertices that split with the last face.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

COLOURS = {"no": "#9aa7b5", "yes": "#d8572a"}


def split(sunder, mesh, *options):
    said = subprocess.run([sunder, "split", str(mesh), *options, "--json"], capture_output=True, text=True)
    return json.loads(said.stdout) if said.returncode == 0 else None


def read_medit(path):
    words = iter(path.read_text().split())
    points, tets = [], []
    for word in words:
        if word == "Vertices":
            points = [[float(next(words)) for _ in range(4)][:3] for _ in range(int(next(words)))]
        elif word == "Tetrahedra":
            tets = [[int(next(words)) - 1 for _ in range(5)][:4] for _ in range(int(next(words)))]
    return points, tets


def write_medit(path, points, tets):
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(points))]
    lines += [" ".join(map(repr, p)) + " 0" for p in points]
    lines += ["Tetrahedra", str(len(tets))] + [" ".join(str(v + 1) for v in t) + " 0" for t in tets]
    path.write_text("\n".join(lines + ["End", ""]))


def closed_fan(count):
    """Tetrahedra round the edge 0-1."""
    points = [[0.0, 0.0, -0.8], [0.0, 0.0, 0.8]]
    for k in range(count):
        angle = 2 * math.pi * k / count
        points.append([math.cos(angle), math.sin(angle), 0.0])
    return points, [[0, 2 + k, 2 + (k + 1) % count, 1] for k in range(count)]


def flat(point, turn=0.5, tilt=0.45):
    """Seen from above: parallel, in the unit of the mesh."""
    x, y, z = point
    right = math.cos(turn) * x + math.sin(turn) * y
    away = -math.sin(turn) * x + math.cos(turn) * y
    return right, -(math.cos(tilt) * z + math.sin(tilt) * away)


def panel(points, tets, splits, title, tilt=0.45):
    """One drawing as SVG in a box of 300 x 300."""
    seen = [flat(p, tilt=tilt) for p in points]
    low = [min(s[k] for s in seen) for k in (0, 1)]
    size = max(max(s[k] for s in seen) - low[k] for k in (0, 1)) or 1
    middle = [(max(s[k] for s in seen) + low[k]) / 2 for k in (0, 1)]
    at = [(150 + 240 * (x - middle[0]) / size, 145 + 240 * (y - middle[1]) / size) for x, y in seen]
    out = []
    for edge in sorted({tuple(sorted((a, b))) for t in tets for a in t for b in t if a != b}):
        (x0, y0), (x1, y1) = at[edge[0]], at[edge[1]]
        out.append(f'<path d="M{x0:.1f} {y0:.1f}L{x1:.1f} {y1:.1f}" stroke="#b9c0c8" stroke-width="0.8"/>')
    for s in splits:
        corners = "L".join(f"{at[v][0]:.1f} {at[v][1]:.1f}" for v in s["face"])
        colour = COLOURS["yes" if s["oracle"] else "no"]
        out.append(f'<path d="M{corners}Z" fill="{colour}" fill-opacity="0.6" stroke="#3b4754"/>')
    for v in splits[-1]["split_vertices"] if splits else []:
        out.append(f'<circle cx="{at[v][0]:.1f}" cy="{at[v][1]:.1f}" r="6" fill="#f2c230" stroke="#3b4754"/>')
    out.append(f'<text x="150" y="294" text-anchor="middle">{title}</text>')
    return "".join(out)


def write_svg(path, panels):
    parts = [f'<g transform="translate({300 * k} 0)">{p}</g>' for k, p in enumerate(panels)]
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {300 * len(panels)} 300" '
                    f'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="white"/>'
                    f'<g fill="none" stroke-linejoin="round"><g fill="#222" stroke="none"></g>'
                    + "".join(parts).replace("<text ", '<text fill="#222" ') + "</g></svg>\n")


def words(s):
    verdict = "yes" if s["oracle"] else "no"
    count = len(s["split_vertices"])
    return f"{count} {'vertex' if count == 1 else 'vertices'}, {len(s['split_edges'])} edges; oracle: {verdict}"


def figure_3(sunder, out, work):
    mesh, faces = work / "fan.mesh", work / "faces.txt"
    points, tets = closed_fan(4)
    write_medit(mesh, points, tets)
    faces.write_text("0 1 2\n0 1 4\n")
    splits = split(sunder, mesh, "--faces", str(faces))["splits"]
    write_svg(out / "figure_3.svg", [panel(points, tets, splits[:k + 1], f"({'ab'[k]}) {words(s)}")
                                     for k, s in enumerate(splits)])


def figure_4(sunder, meshes, out, work):
    subprocess.run([sunder, "convert", str(meshes / "ring.msh"), str(work / "ring.mesh")], check=True,
                   capture_output=True)
    points, tets = read_medit(work / "ring.mesh")
    splits = split(sunder, meshes / "ring.msh", "--plane", "1,0,0,1.01")["splits"]
    titles = {1: "(a) one side cut: the oracle is wrong", 3: "(b) both cut: a new component"}
    write_svg(out / "figure_4.svg", [panel(points, tets, splits[:k + 1], t) for k, t in titles.items()])


def figure_5(sunder, meshes, out, work):
    """The first fan of the monolith that is split without a new component, wrongly expected in one order alone."""
    subprocess.run([sunder, "convert", str(meshes / "monolith.msh"), str(work / "m.mesh")], check=True,
                   capture_output=True)
    points, tets = read_medit(work / "m.mesh")
    for vertex in range(len(points)):
        for normal in ("1,0,0", "0,1,0", "0,0,1"):
            found = {order: split(sunder, meshes / "monolith.msh", "--fan", f"{vertex},{normal}", "--order", order)
                     for order in ("given", "paper")}
            if not all(found.values()):
                continue
            said = {o: any(s["oracle"] for s in f["splits"]) for o, f in found.items()}
            parted = any(s["new_component"] for s in found["given"]["splits"])
            if parted or not said["given"] or said["paper"] or len(found["given"]["splits"]) < 4:
                continue
            star = [t for t in tets if vertex in t]
            rows = sorted({v for t in star for v in t})
            small = {v: k for k, v in enumerate(rows)}
            local = [points[v] for v in rows]
            cells = [[small[v] for v in t] for t in star]
            panels = []
            for order, title in (("given", "(a) as numbered"), ("paper", "(b) surface first")):
                splits = [{**s, "face": [small[v] for v in s["face"]],
                           "split_vertices": [small[v] for v in s["split_vertices"]]}
                          for s in found[order]["splits"]]
                panels.append(panel(local, cells, splits, f"{title}: {words(splits[-1])}", tilt=1.0))
            write_svg(out / "figure_5.svg", panels)
            print(f"figure 5: the fan of vertex {vertex} with normal {normal} in the monolith")
            return
    sys.exit("figure 5: no such fan in the monolith")


def main():
    sunder, meshes, out = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        figure_3(sunder, out, work)
        figure_4(sunder, meshes, out, work)
        figure_5(sunder, meshes, out, work)


if __name__ == "__main__":
    main()

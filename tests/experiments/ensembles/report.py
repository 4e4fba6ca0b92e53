# SPDX-License-Identifier: MIT
"""Tables, CSV, JSON and picture of the runs that ensembles.py made."""
import csv
import itertools
import json
import subprocess
import sys

import figures

MODES = ("paper", "object")
GROUPS = ("1x", "2x", "starts", "strengths")
NAMES = ("pieces", "largest", "debris")
NULL = ("starts", "strengths")
# Two groups of five have 252 regroupings: nothing is rarer than 1 in 126.
RARE = 0.02
TITLES = {"1x": "meshes, 1x", "2x": "meshes, 2x", "starts": "one mesh, starts moved", "strengths": "one mesh, strengths moved"}


def number(value):
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.1f}" if abs(value) >= 1 else f"{value:.3f}"


def debris_length(records):
    """Two cells of the coarse mesh: twice the cube root of the mean tetrahedron of the first mesh, m."""
    for r in records:
        if r["volumes"] and r["group"] in (*NULL, "1x") and r["member"] == 0:
            return 2 * (sum(r["volumes"]) / r["tetrahedra"]) ** (1 / 3)
    return None


def volumes(records, mode, *groups):
    return [r["volumes"] for r in records if r["mode"] == mode and r["group"] in groups and r["volumes"]]


def group_of(records, mode, group, debris):
    mine = [r for r in records if r["mode"] == mode and r["group"] == group]
    runs = volumes(mine, mode, group)
    found = {"mode": mode, "group": group, "runs": len(mine), "without": sorted(r["end"] for r in mine if not r["volumes"])}
    if runs:
        each = [figures.outcomes(run, debris) for run in runs]
        found |= {name: figures.spread([o[name] for o in each]) for name in NAMES}
        found["distance"] = figures.mean_pairwise(runs)
        found["different"] = len({tuple(run) for run in runs})
        found["tetrahedra"] = figures.spread([r["tetrahedra"] for r in mine if r["volumes"]])
    return found


def null_band(groups, modes):
    """Width of the band of runs moved by nothing, in the mode where it is wider."""
    band = {}
    for name in NAMES:
        band[name] = max(max(g[name]["most"] for g in mine) - min(g[name]["least"] for g in mine)
                         for mode in modes if (mine := [g for g in groups if g["mode"] == mode and g["group"] in NULL and "pieces" in g]))
    return band


def comparisons(records, groups, debris):
    """Pairs of groups to compare, each next to the numerical-noise band of their modes."""
    pairs = [("paper -> object, 1x", MODES, ("paper", ["1x"]), ("object", ["1x"])),
             ("paper -> object, 2x", MODES, ("paper", ["2x"]), ("object", ["2x"]))]
    for mode in MODES:
        pairs += [(f"{mode}, 1x -> 2x", [mode], (mode, ["1x"]), (mode, ["2x"])),
                  (f"{mode}, one mesh -> meshes", [mode], (mode, ["starts"]), (mode, ["1x"]))]
    found = []
    for title, modes, one, other in pairs:
        a, b = volumes(records, one[0], *one[1]), volumes(records, other[0], *other[1])
        if not a or not b or any(not volumes(records, mode, *NULL) for mode in modes):
            continue
        band = null_band(groups, modes)
        # Of distributions: one half of the runs with moved starts against the other.
        band["distance"] = max(figures.kolmogorov(runs[::2], runs[1::2]) if len(runs := volumes(records, mode, "starts")) > 1 else 0.0
                               for mode in modes)
        found.append({"title": title, "null_band": band, **figures.compare(a, b, debris)})
    return found


def group_table(said):
    lines = ["| scene | mode | runs | n | different | tetrahedra | pieces | largest piece | debris | distance of two runs |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for scene, g in ((scene, g) for scene, found in said.items() for g in found["groups"]):
        cells = [scene, g["mode"], TITLES[g["group"]], str(g["runs"] - len(g["without"]))]
        if g["without"]:
            cells[-1] += f" of {g['runs']} ({'; '.join(g['without'])})"
        if "pieces" in g:
            cells += [str(g["different"]), number(g["tetrahedra"]["mean"])]
            cells += [f"{number(s['mean'])} +- {number(s['deviation'])} [{number(s['least'])}, {number(s['most'])}]"
                      for s in (g[name] for name in NAMES)]
            cells.append(f"{g['distance']:.3f}")
        lines.append("| " + " | ".join(cells + [""] * (10 - len(cells))) + " |")
    return lines


def comparison_table(said):
    """Differences, with (null band; probability by chance); those beyond the band and as rare as RARE are bold."""
    lines = ["| scene | compared | pieces | largest piece | debris | distance |", "|---|---|---|---|---|---|"]
    for scene, c in ((scene, c) for scene, found in said.items() for c in found["comparisons"]):
        cells = [scene, c["title"]]
        for name in (*NAMES, "distance"):
            sign = "+" if name != "distance" and c[name]["difference"] > 0 else ""
            text = sign + number(c[name]["difference"])
            if abs(c[name]["difference"]) > c["null_band"][name] and c[name]["by_chance"] <= RARE:
                text = f"**{text}**"
            cells.append(f"{text} ({number(c['null_band'][name])}; {c[name]['by_chance']:.3f})")
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def write_csv(path, by_scene):
    with open(path, "w", newline="") as table:
        out = csv.writer(table, lineterminator="\n")
        out.writerow(["scene", "mode", "group", "member", "end", "tetrahedra", *NAMES])
        for scene, (records, debris) in by_scene.items():
            for r in sorted(records, key=lambda r: (MODES.index(r["mode"]), GROUPS.index(r["group"]), r["member"])):
                said = [""] * 4
                if r["volumes"]:
                    o = figures.outcomes(r["volumes"], debris)
                    said = [r["tetrahedra"], o["pieces"], f"{o['largest']:.6g}", f"{o['debris']:.6g}"]
                out.writerow([scene, r["mode"], r["group"], r["member"], r["end"], *said])


def curves(runs, grid):
    rows = [figures.shares(run, grid) for run in runs]
    return list(zip(grid, figures.mean_shares(rows), map(min, *rows, rows[0]), map(max, *rows, rows[0])))


def block(name, rows):
    return f"${name} << EOD\n" + "".join(" ".join(f"{x:.5g}" for x in row) + "\n" for row in rows) + "EOD\n"


def picture(by_scene):
    """gnuplot's script: a panel a scene, share of mass in pieces up to a size, mean and band of each group."""
    data, panels = "", ""
    for k, (scene, (records, debris)) in enumerate(by_scene.items()):
        every = [r["volumes"] for r in records if r["volumes"]]
        low, high = 0.6 * figures.thin_grid(every)[0], 1.02 * max(map(max, every)) ** (1 / 3)
        grid, drawn, lines = [low * (high / low) ** (i / 300) for i in range(301)], [], []
        for mode, color in zip(MODES, ("#d55e00", "#0072b2")):
            for groups, width, dash, fill in ((["1x"], 2, 1, 0.16), (["2x"], 2, 3, None), (NULL, 1, 2, 0.3)):
                runs = volumes(records, mode, *groups)
                if not runs:
                    continue
                name = f"D{k}{mode}{groups[0]}"
                data += block(name, curves(runs, grid))
                title = f"{mode}, {'one mesh, moved by nothing' if groups is NULL else 'meshes, ' + groups[0]}"
                if fill:
                    drawn.append(f"${name} using 1:3:4 with filledcurves fc rgb '{color}' fs transparent solid {fill} noborder notitle")
                lines.append(f"${name} using 1:2 with lines lc rgb '{color}' lw {width} dt {dash} title '{title}'")
        panels += (f"set title '{scene}'\nset xrange [{low:.5g}:{high:.5g}]\nset arrow 1 from {debris:.5g},0 to {debris:.5g},1 nohead lc rgb '#888888' dt 4\n"
                   f"plot {', '.join(drawn + lines)}\nset key off\n")
    return ("set terminal pngcairo noenhanced size 1300,1000 font 'DejaVu Sans,11'\n" + data +
            "set multiplot layout 2,2\nset logscale x\nset yrange [0:1]\nset grid lc rgb '#e4e4e4'\nset key top left font ',10' samplen 2\n"
            "set xlabel 'size of piece, m (cube root of volume); grey: two cells'\nset ylabel 'mass share of smaller pieces'\n" + panels)


def draw(script, path):
    try:
        done = subprocess.run(["gnuplot"], input=script.encode(), capture_output=True)
    except FileNotFoundError:
        print("no gnuplot: sizes.png is not drawn", file=sys.stderr)
        return
    if done.returncode != 0:
        raise RuntimeError(done.stderr.decode())
    path.write_bytes(done.stdout)


def write(out, records):
    by_scene = {}
    for scene, mine in itertools.groupby(records, key=lambda r: r["scene"]):
        mine = list(mine)
        if debris := debris_length(mine):
            by_scene[scene] = (mine, debris)
    said = {}
    for scene, (mine, debris) in by_scene.items():
        groups = [group_of(mine, mode, group, debris) for mode in MODES for group in GROUPS
                  if any(r["mode"] == mode and r["group"] == group for r in mine)]
        found = comparisons(mine, groups, debris)
        said[scene] = {"debris_length": debris, "groups": groups, "comparisons": found}
    lengths = ", ".join(f"{scene} {1e3 * found['debris_length']:.3g} mm" for scene, found in said.items())
    print("\n".join([f"Debris is smaller than: {lengths}", "", *group_table(said), "", *comparison_table(said)]))
    write_csv(out / "runs.csv", by_scene)
    (out / "groups.json").write_text(json.dumps(said, indent=1) + "\n")
    if by_scene:
        draw(picture(by_scene), out / "sizes.png")

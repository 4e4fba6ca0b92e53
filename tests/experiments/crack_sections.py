#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many sections of crack a scene of one body makes: is it one main crack?

    tests/experiments/crack_sections.py SCENE AXIS MIDDLE SECTION [--cubes NX NY NZ] [--set KEY=VALUE ...]

AXIS (x, y or z of the mesh) is that along which the crack would part the body, MIDDLE (m) where on it, SECTION (m^2) the
area there. Runs SCENE in mode `object` and prints, up to the fan that leaves no piece of three quarters
of the body, and to the end: fans, pieces, the largest as a share of the volume, area of crack over the section, the same
projected along AXIS, the farthest fan from MIDDLE (m)."""
import argparse
import itertools
import json
import math
import pathlib
import subprocess
import tempfile


def mesh_of(sunder, mesh, folder):
    """Points and tetrahedra."""
    path = folder / "mesh.mesh"
    subprocess.run([sunder, "convert", mesh, path], check=True, capture_output=True)
    words = path.read_text().split()
    block = lambda name, n: [words[k:k + n] for k in range(words.index(name) + 2, words.index(name) + 2 +
                                                           (n + 1) * int(words[words.index(name) + 1]), n + 1)]
    return ([tuple(map(float, p)) for p in block("Vertices", 3)],
            [tuple(int(v) - 1 for v in t) for t in block("Tetrahedra", 4)])


def pieces_of(points, tetrahedra, fans):
    """Volumes of the pieces that these fans leave, as shares, the largest first."""
    open_faces = {tuple(sorted(face["points"])) for fan in fans for face in fan["faces"]}
    root = list(range(len(tetrahedra)))

    def find(t):
        while root[t] != t:
            root[t] = root[root[t]]
            t = root[t]
        return t

    beside = {}
    for k, t in enumerate(tetrahedra):
        for left_out in range(4):
            face = tuple(sorted(t[:left_out] + t[left_out + 1:]))
            if face in beside and face not in open_faces:
                root[find(k)] = find(beside[face])
            beside[face] = k
    volumes = {}
    for k, t in enumerate(tetrahedra):
        a, b, c, d = (points[v] for v in t)
        volume = abs(sum(x * (q - p) for x, p, q in zip(area_vector(a, b, c), a, d))) / 3
        volumes[find(k)] = volumes.get(find(k), 0) + volume
    return sorted((v / sum(volumes.values()) for v in volumes.values()), reverse=True)


def cubes(points, counts):
    """The box of the points as cubes of six tetrahedra each, as MEDIT."""
    low, high = ([f(p[i] for p in points) for i in range(3)] for f in (min, max))
    row = lambda c: (c[2] * (counts[1] + 1) + c[1]) * (counts[0] + 1) + c[0]
    places = [c[::-1] for c in itertools.product(*(range(n + 1) for n in reversed(counts)))]
    lines = ["MeshVersionFormatted 2", "Dimension 3", f"Vertices\n{len(places)}"]
    lines += [" ".join(repr(a + (b - a) * k / n) for a, b, k, n in zip(low, high, c, counts)) + " 0" for c in places]
    lines.append(f"Tetrahedra\n{6 * math.prod(counts)}")
    for first in itertools.product(*(range(n) for n in counts)):
        for order in itertools.permutations(range(3)):
            corner, t = list(first), [row(first) + 1]
            for axis in order:
                corner[axis] += 1
                t.append(row(corner) + 1)
            if sum(order[a] > order[b] for a in range(3) for b in range(a + 1, 3)) % 2:
                t[2:] = t[:1:-1]
            lines.append(" ".join(map(str, t)) + " 0")
    return "\n".join(lines + ["End\n"])


def area_vector(a, b, c):
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    return [(u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) / 2 for i in range(3)]


def sections(fans, points, axis, middle, section):
    raw = projected = far = 0
    for fan in fans:
        far = max(far, abs(fan["rest_position"][axis] - middle))
        for face in fan["faces"]:
            area = area_vector(*(points[p] for p in face["points"]))
            raw += math.hypot(*area) / section
            projected += abs(area[axis]) / section
    return f"{raw:.2f} / {projected:.2f} / {far:.3f}"


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scene", type=pathlib.Path)
    words.add_argument("axis", choices="xyz")
    words.add_argument("middle", type=float)
    words.add_argument("section", type=float)
    words.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    words.add_argument("--cubes", type=int, nargs=3, help="in place of the mesh: its box, of so many cubes along x, y, z")
    words.add_argument("--set", action="append", default=[])
    said = words.parse_args()
    sunder, axis = said.build / "sunder", "xyz".index(said.axis)
    changes = ["fracture.crack=object", *said.set]
    mesh = said.scene.parent / json.loads(said.scene.read_text())["bodies"][0]["mesh"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        points, tetrahedra = mesh_of(sunder, mesh, folder)
        if said.cubes:
            mesh = folder / "cubes.mesh"
            mesh.write_text(cubes(points, said.cubes))
            points, tetrahedra = mesh_of(sunder, mesh, folder)
            changes.append(f"bodies.0.mesh={mesh}")
        run = [sunder, "run", said.scene, "--quiet", "--frames", "0", "--force", "-o", folder / "run"]
        subprocess.run([*run, *(w for c in changes for w in ("--set", c))], check=True, capture_output=True)
        events = [json.loads(line) for line in (folder / "run/events.jsonl").read_text().splitlines()]
    fans = [e for e in events if "fan" in e]
    if not fans:
        return print("nothing broke")
    for k, fan in enumerate(fans):
        if (k + 1 == len(fans) or fan["new_components"]) and pieces_of(points, tetrahedra, fans[:k + 1])[0] < 0.75:
            parted = fans[:k + 1]
            break
    else:
        parted = []
    print(f"first fan at {fans[0]['time']:.4f} s, {fans[0]['stress'] / fans[0]['strength'] - 1:.4f} over its strength")
    for name, some in (("when parted", parted), ("in all", fans)):
        if not some:
            print(f"  {name:12} not")
            continue
        pieces = pieces_of(points, tetrahedra, some)
        print(f"  {name:12} {some[-1]['time']:.4f} s, {len(some)} fans, {len(pieces)} pieces, largest {pieces[0]:.3f}; "
              f"{sections(some, points, axis, said.middle, said.section)}")


if __name__ == "__main__":
    main()

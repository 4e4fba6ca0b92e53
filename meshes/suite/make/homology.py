# SPDX-License-Identifier: MIT
"""Homology of the orbits of a glued body: over a field by reducing columns, over Z by the Smith
normal form.

Every cell's corners are ordered by the file's points, so that gluing never reverses a cell.
"""

from twin import EDGE_NUMBER, EDGES


def orbit_complex(glued):
    """Boundary columns {row: +-1} of every cell, by dimension 0 to 3."""
    corners, edges = glued.orbits()
    numbers = ({}, {}, {})
    columns = [[], [], [], []]

    def number(dimension, key):
        rows = numbers[dimension]
        if key not in rows:
            rows[key] = len(rows)
            columns[dimension].append(None)
        return rows[key]

    for t, tet in enumerate(glued.tets):
        order = sorted(range(4), key=lambda i: tet[i])
        vertex = [number(0, corners.root(4 * t + i)) for i in range(4)]
        for v in vertex:
            columns[0][v] = {}
        edge = {}
        for a, b in EDGES:
            i, j = order[a], order[b]
            e = edge[a, b] = number(1, edges.root(6 * t + EDGE_NUMBER[i, j]))
            columns[1][e] = {vertex[j]: 1, vertex[i]: -1}
        face = []
        for left_out in range(4):
            h = 4 * t + order[left_out]
            f = number(2, min(h, glued.other[h]) if glued.other[h] >= 0 else h)
            a, b, c = (n for n in range(4) if n != left_out)
            columns[2][f] = {edge[b, c]: 1, edge[a, c]: -1, edge[a, b]: 1}
            face.append(f)
        columns[3].append({f: (-1) ** n for n, f in enumerate(face)})
    return columns


def betti_mod(columns, prime):
    """Betti numbers b0 to b3 over the field of `prime` elements."""
    rank = [0] * 5
    for d in (3, 2, 1):
        pivots = {}
        for column in columns[d]:
            column = {r: c % prime for r, c in column.items()}
            while column:
                low = max(column)
                if low not in pivots:
                    inverse = pow(column[low], -1, prime)
                    pivots[low] = {r: c * inverse % prime for r, c in column.items()}
                    break
                factor = column[low]
                for r, c in pivots[low].items():
                    value = (column.get(r, 0) - factor * c) % prime
                    if value:
                        column[r] = value
                    else:
                        column.pop(r, None)
        rank[d] = len(pivots)
    return [len(columns[d]) - rank[d] - rank[d + 1] for d in range(4)]


def smith(columns):
    """The non-zero diagonal of the Smith normal form: how many are 1, and the others, rising."""
    columns = {c: dict(column) for c, column in enumerate(columns) if column}
    rows = {}
    for c, column in columns.items():
        for r in column:
            rows.setdefault(r, set()).add(c)
    ones = 0
    todo = sorted(columns)
    while todo:  # pivots of 1 while there are any
        again = []
        for c in todo:
            units = [r for r, x in columns.get(c, {}).items() if abs(x) == 1]
            if not units:
                continue
            pivot = min(units, key=lambda r: (len(rows[r]), r))
            column = columns.pop(c)
            for r in column:
                rows[r].discard(c)
            for k in sorted(rows.pop(pivot)):
                other = columns[k]
                factor = other[pivot] * column[pivot]
                for r, x in column.items():
                    value = other.get(r, 0) - factor * x
                    if value:
                        other[r] = value
                        if r != pivot:
                            rows[r].add(k)
                    elif r in other:
                        del other[r]
                        if r != pivot:
                            rows[r].discard(k)
                again.append(k)
            ones += 1
        todo = sorted(set(again) & set(columns))
    names = sorted({r for column in columns.values() for r in column})
    rest = [[column.get(r, 0) for r in names] for column in columns.values() if column]
    diagonal = dense_smith(rest)
    return ones + diagonal.count(1), [d for d in diagonal if d > 1]


def dense_smith(matrix):
    """Textbook: the smallest entry to the corner, clear its row and column, mend divisibility."""
    diagonal = []
    while any(any(row) for row in matrix):
        _, i, j = min((abs(x), i, j) for i, row in enumerate(matrix)
                      for j, x in enumerate(row) if x)
        matrix[0], matrix[i] = matrix[i], matrix[0]
        for row in matrix:
            row[0], row[j] = row[j], row[0]
        pivot = matrix[0][0]
        clean = True
        for row in matrix[1:]:
            factor = row[0] // pivot
            for n in range(len(row)):
                row[n] -= factor * matrix[0][n]
            clean &= row[0] == 0
        for n in range(1, len(matrix[0])):
            factor = matrix[0][n] // pivot
            for row in matrix:
                row[n] -= factor * row[0]
            clean &= matrix[0][n] == 0
        if not clean:
            continue
        bad = next((row for row in matrix[1:] if any(x % pivot for x in row)), None)
        if bad is not None:
            matrix[0] = [a + b for a, b in zip(matrix[0], bad)]
            continue
        diagonal.append(abs(pivot))
        matrix = [row[1:] for row in matrix[1:]]
    return diagonal


def integer_homology(columns):
    """Ranks and torsion coefficients in dimensions 0 to 3."""
    rank, torsion = [0] * 5, [[] for _ in range(5)]
    for d in (1, 2, 3):
        ones, torsion[d - 1] = smith(columns[d])
        rank[d] = ones + len(torsion[d - 1])
    betti = [len(columns[d]) - rank[d] - rank[d + 1] for d in range(4)]
    return {"betti": betti, "torsion": torsion[:4]}


def universal_coefficients(homology, prime):
    """Betti numbers over a field that the homology over Z implies."""
    torsion = [sum(1 for k in ks if k % prime == 0) for ks in homology["torsion"]]
    return [b + torsion[d] + (torsion[d - 1] if d else 0)
            for d, b in enumerate(homology["betti"])]

# SPDX-License-Identifier: MIT
"""Distances of distributions and probabilities by chance where they are known, and surfaces that are closed."""
import collections
import math
import random
import unittest

import figures
import members


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def volume(points, faces):
    return sum(sum(x * y for x, y in zip(points[a], cross(points[b], points[c]))) for a, b, c in faces) / 6


class Figures(unittest.TestCase):
    def test_outcomes_are_shares_of_the_volume(self):
        found = figures.outcomes([6.0, 1.0, 2.0, 1.0], debris=1.1)
        self.assertEqual(found["pieces"], 4)
        self.assertAlmostEqual(found["largest"], 0.6)
        self.assertAlmostEqual(found["debris"], 0.2)

    def test_distance_is_weighted_by_mass(self):
        self.assertAlmostEqual(figures.kolmogorov([[1.0, 1.0, 2.0]], [[1.0, 3.0]]), 0.75)  # of size 2 and less: all and a quarter
        self.assertAlmostEqual(figures.kolmogorov([[1.0, 3.0]], [[2.0, 6.0]]), 0.75)
        self.assertEqual(figures.kolmogorov([[1.0, 3.0]], [[1.0, 3.0]]), 0.0)
        # Pooled: the mean of both members' distributions is that of the other group's one.
        self.assertAlmostEqual(figures.kolmogorov([[1.0], [8.0]], [[1.0] * 8 + [8.0]]), 0.0)
        self.assertAlmostEqual(figures.mean_pairwise([[1.0], [1.0], [8.0]]), 2 / 3)

    def test_what_is_the_same_by_law_is_rarely_apart(self):
        source = random.Random(7)
        draw = lambda mean: [source.gauss(mean, 1) for _ in range(10)]
        apart = lambda a, b: abs(sum(a) / len(a) - sum(b) / len(b))
        rare = sum(figures.by_chance(draw(0) + draw(0), 10, apart, draws=199) <= 0.1 for _ in range(100))
        self.assertTrue(2 <= rare <= 20, rare)  # ten are expected, with a deviation of three
        self.assertEqual(figures.by_chance(draw(0) + draw(20), 10, apart, draws=199), 1 / 200)
        self.assertEqual(figures.by_chance([1.0] * 20, 10, apart, draws=9), 1.0)

    def test_two_groups_are_told_apart_by_size_alone(self):
        fine, coarse = [[1.0] * n for n in (60, 62, 64, 66)], [[8.0] * n for n in (7, 8, 9, 10)]
        found = figures.compare(fine, coarse, debris=1.5)
        self.assertAlmostEqual(found["pieces"]["difference"], 8.5 - 63)
        self.assertAlmostEqual(found["debris"]["difference"], -1)
        self.assertEqual(found["distance"]["difference"], 1)
        self.assertLess(found["distance"]["by_chance"], 0.08)  # 2 of 70 regroupings


class Surfaces(unittest.TestCase):
    def test_surfaces_are_closed_and_turn_outward(self):
        for name, (points, faces), exact in (("box", members.box((-1, 0, 0), (1, 3, 0.5)), 3.0),
                                             ("ball", members.ball(2), 32 / 3 * math.pi)):
            with self.subTest(name):
                edges = collections.Counter((f[k], f[(k + 1) % 3]) for f in faces for k in range(3))
                self.assertTrue(all(n == 1 and edges[(b, a)] == 1 for (a, b), n in edges.items()))
                self.assertAlmostEqual(volume(points, faces) / exact, 1, delta=0.01)
                self.assertEqual(members.read_off(members.off(points, faces)), (points, faces))

    def test_a_turn_turned_back_is_none(self):
        rows = members.rotation(random.Random(3))
        points = [(1.0, 2.0, 3.0), (-0.5, 0.0, 7.0)]
        for p, q in zip(points, members.turned(list(zip(*rows)), members.turned(rows, points))):
            for x, y in zip(p, q):
                self.assertAlmostEqual(x, y, places=14)


if __name__ == "__main__":
    unittest.main()

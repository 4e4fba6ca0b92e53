# SPDX-License-Identifier: MIT
"""Figures of a group of runs: mean and band of outcomes, distances between distributions of sizes.

A run is the list of its pieces' volumes, m^3. Its distribution of sizes is weighted by mass: F(s) is the share of
the body's volume in pieces of size (cube root of volume) s and below. A group's is the mean of its runs'."""
import bisect
import itertools
import random
import statistics


def outcomes(volumes, debris):
    """Number of pieces, share of the largest, share of those smaller than the length `debris` (m)."""
    whole = sum(volumes)
    return {"pieces": len(volumes), "largest": max(volumes) / whole,
            "debris": sum(v for v in volumes if v < debris ** 3) / whole}


def spread(values):
    """Mean, standard deviation (0 of one value), least and largest."""
    return {"mean": statistics.fmean(values), "deviation": statistics.stdev(values) if len(values) > 1 else 0.0,
            "least": min(values), "most": max(values)}


def sizes(volumes):
    return [v ** (1 / 3) for v in volumes]


def shares(volumes, grid):
    """F at every size of an ascending grid."""
    ordered, whole = sorted(volumes), sum(volumes)
    lengths, below = sizes(ordered), [0.0, *itertools.accumulate(ordered)]
    return [below[bisect.bisect_right(lengths, s)] / whole for s in grid]


def mean_shares(rows):
    return [statistics.fmean(column) for column in zip(*rows)]


def gap(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def kolmogorov(group, other):
    """Largest difference of the mass-weighted distributions of two groups of runs; exact."""
    grid = sorted({s for run in (*group, *other) for s in sizes(run)})
    return gap(mean_shares([shares(run, grid) for run in group]), mean_shares([shares(run, grid) for run in other]))


def mean_pairwise(group):
    """Mean distance of two runs of a group; 0 of one run."""
    pairs = [kolmogorov([a], [b]) for a, b in itertools.combinations(group, 2)]
    return statistics.fmean(pairs) if pairs else 0.0


def thin_grid(runs, count=200):
    """Sizes between which lies at most 1 / count of the runs' volume, but for pieces larger than that."""
    ordered = sorted(v for run in runs for v in run)
    step, grid, passed = sum(ordered) / count, [], 0.0
    for v in ordered:
        passed += v
        if passed >= step:
            grid.append(v ** (1 / 3))
            passed = 0.0
    return grid


def by_chance(rows, first, statistic, draws=999, seed=1):
    """Probability that two groups drawn at random from the `rows` of both, the one of `first` rows, are as far
    apart as the first `first` rows are from the others: a permutation test, which knows no law of the rows."""
    seen, source, order = statistic(rows[:first], rows[first:]), random.Random(seed), list(rows)
    as_far = 1  # the one that was seen
    for _ in range(draws):
        source.shuffle(order)
        as_far += statistic(order[:first], order[first:]) >= seen * (1 - 1e-12)
    return as_far / (draws + 1)


def compare(group, other, debris):
    """Difference of means and distance of two groups, each with its probability by chance."""
    runs = [*group, *other]
    found, each = {}, [outcomes(run, debris) for run in runs]
    for name in each[0]:
        values = [o[name] for o in each]
        found[name] = {"difference": statistics.fmean(values[len(group):]) - statistics.fmean(values[:len(group)]),
                       "by_chance": by_chance(values, len(group), lambda a, b: abs(statistics.fmean(a) - statistics.fmean(b)))}
    grid = thin_grid(runs)
    rows = [shares(run, grid) for run in runs]
    found["distance"] = {"difference": kolmogorov(group, other),
                         "by_chance": by_chance(rows, len(group), lambda a, b: gap(column_means(a), column_means(b)))}
    return found


def column_means(rows):
    return [sum(column) / len(rows) for column in zip(*rows)]

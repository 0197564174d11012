# SPDX-License-Identifier: BSD-3-Clause
"""R-hat, effective sizes and Monte Carlo errors from the formulas of Vehtari et al. 2021, by plain sums.

    diagnostics_reference.py DRAWS.csv      a row for each step, a column for each chain

Prints one "name value" a line. Shares nothing with calibration/diagnostics.cpp, which is compared with it.
"""
import sys
from math import ceil, floor, lgamma, log10
from statistics import NormalDist
import numpy as np


def split(x):
    half = len(x) // 2
    return np.hstack([x[:half], x[len(x) - half:]])


def scores(x):
    flat = x.ravel()
    rank = np.array([np.sum(flat < v) + (np.sum(flat == v) + 1) / 2 for v in flat])
    return np.array([NormalDist().inv_cdf((r - 3 / 8) / (flat.size + 1 / 4)) for r in rank]).reshape(x.shape)


def rhat(x):
    n = len(x)
    between = n * x.mean(axis=0).var(ddof=1)
    within = x.var(axis=0, ddof=1).mean()
    return (((n - 1) / n * within + between / n) / within) ** 0.5


def ess(x):
    n, m = x.shape
    centred = x - x.mean(axis=0)
    acov = np.array([(centred[: n - lag] * centred[lag:]).sum(axis=0) / n for lag in range(n)])
    within = (acov[0] * n / (n - 1)).mean()
    total = within * (n - 1) / n + x.mean(axis=0).var(ddof=1)
    rho = 1 - (within - acov.mean(axis=1)) / total
    rho[0] = 1
    pairs, lag = [], 0
    while lag + 3 < n and rho[lag] + rho[lag + 1] > 0:
        pairs.append(rho[lag] + rho[lag + 1])
        lag += 2
    tau = -1 + 2 * np.minimum.accumulate(pairs).sum() + max(rho[lag], 0)
    return n * m / max(tau, 1 / log10(n * m))


def beta_quantile(level, a, b):
    """By the trapezoidal rule on a fine grid."""
    t = np.linspace(0, 1, 2_000_001)[1:-1]
    density = np.exp((a - 1) * np.log(t) + (b - 1) * np.log1p(-t) - lgamma(a) - lgamma(b) + lgamma(a + b))
    return float(np.interp(level, np.cumsum(density) / density.sum(), t))


def main():
    x = np.loadtxt(sys.argv[1], delimiter=",", ndmin=2)
    halves = split(x)
    low, high = np.quantile(x, 0.05), np.quantile(x, 0.95)
    ess_low, ess_high = ess(split((x <= low) * 1.0)), ess(split((x <= high) * 1.0))
    ordered = np.sort(x.ravel())
    level = NormalDist().cdf(1)
    a, b = ess_low * 0.05 + 1, ess_low * 0.95 + 1
    first = max(floor(beta_quantile(1 - level, a, b) * x.size), 1)
    last = min(ceil(beta_quantile(level, a, b) * x.size), x.size)
    held = ceil(0.9 * x.size)
    widths = ordered[held - 1:] - ordered[: x.size - held + 1]
    results = {
        "rhat": max(rhat(scores(halves)), rhat(scores(abs(halves - np.median(halves))))),
        "bulk": ess(scores(halves)),
        "tail": min(ess_low, ess_high),
        "mean_error": x.std(ddof=1) / ess(halves) ** 0.5,
        "lower_error": (ordered[last - 1] - ordered[first - 1]) / 2,
        "lower": low,
        "upper": high,
        "shortest": ordered[widths.argmin()],
    }
    for name, value in results.items():
        print(name, repr(float(value)))


main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a chain: trace with ranks, marginals and pairs, correlation. Usage: chain.py CHAIN.h5 [-o DIR]"""
import argparse
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

# Colours that stay apart for colour-blind readers (Okabe and Ito).
BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#555555"
plt.rcParams.update({"font.size": 9, "savefig.dpi": 160, "axes.axisbelow": True})


class Chain:
    """Samples (steps, walkers, dimensions), log densities (steps, walkers) and names of a file of `simsand`."""

    def __init__(self, path):
        try:
            with h5py.File(path) as file:
                if file.attrs.get("format") not in ("simsand chain", b"simsand chain"):
                    sys.exit(f"{path}: not a chain of simsand")
                self.samples, self.log_density = file["samples"][()], file["log_density"][()]
                names = file.attrs["names"]
                self.complete, self.acceptance = bool(file.attrs["complete"]), float(file.attrs["acceptance"])
        except OSError as error:
            sys.exit(f"{path}: {error}")
        if len(self.samples) < 8:
            sys.exit(f"{path}: {len(self.samples)} kept steps, nothing to draw yet (8 needed)")
        given = (names if isinstance(names, str) else names.decode()).split("\n")
        d = self.samples.shape[2]
        self.names = given if len(given) == d else [f"dimension {i}" for i in range(d)]
        self.pooled = self.samples.reshape(-1, d)

    def title(self):
        steps, walkers, _ = self.samples.shape
        state = "" if self.complete else ", not complete"
        return f"{steps} steps of {walkers} walkers{state}; acceptance {self.acceptance:.2f}"


def trace(chain):
    """Left: every walker's way, mean of the walkers. Right: for each walker, how its samples rank among all; flat
    bars if all walkers sample the same (Vehtari et al. 2021)."""
    steps, walkers, d = chain.samples.shape
    columns = [(name, chain.samples[:, :, i]) for i, name in enumerate(chain.names)] + [
        ("log density", chain.log_density)]
    fig, axes = plt.subplots(d + 1, 2, figsize=(9, 1.25 * (d + 1)), width_ratios=(3, 1), squeeze=False,
                             layout="constrained")
    every = max(1, steps // 1500)
    for (name, values), (left, right) in zip(columns, axes):
        left.plot(np.arange(0, steps, every), values[::every], lw=0.3, alpha=0.35, color=GREY, rasterized=True)
        left.plot(values.mean(axis=1), lw=0.9, color=ORANGE)
        left.set_ylabel(name)
        left.set_xlim(0, steps - 1)
        rank = values.ravel().argsort(kind="stable").argsort().reshape(values.shape) / values.size
        parts = np.array([np.histogram(rank[:, w], bins=20, range=(0, 1))[0] for w in range(walkers)]) / steps * 20
        image = right.imshow(parts, aspect="auto", cmap="RdBu_r", vmin=0, vmax=2, origin="lower",
                             extent=(0, 1, 0.5, walkers + 0.5), interpolation="nearest")
        right.set_ylabel("walker")
        if left is not axes[-1, 0]:
            left.tick_params(labelbottom=False)
            right.tick_params(labelbottom=False)
    axes[-1, 0].set_xlabel("kept step")
    axes[-1, 1].set_xlabel("rank among all samples")
    axes[0, 0].set_title("walkers (grey), their mean", fontsize=9)
    axes[0, 1].set_title("share of each rank", fontsize=9)
    fig.colorbar(image, ax=list(axes[:, 1]), label="1: as all walkers together", shrink=0.4, pad=0.03)
    fig.suptitle(chain.title())
    return fig


def levels_of(counts, parts):
    """Heights of a density above which the given parts of its mass lie."""
    ordered = np.sort(counts.ravel())[::-1]
    mass = np.cumsum(ordered) / ordered.sum()
    return sorted({ordered[min(np.searchsorted(mass, part), ordered.size - 1)] for part in parts})


def smooth(counts):
    """Binomial kernel, once along each side."""
    for axis in (0, 1):
        padded = np.pad(counts, [(1, 1) if a == axis else (0, 0) for a in (0, 1)])
        counts = sum(w * np.take(padded, range(k, k + counts.shape[axis]), axis=axis)
                     for k, w in ((0, 0.25), (1, 0.5), (2, 0.25)))
    return counts


def pairs(chain):
    """Diagonal: marginal with mean and interval of 90 %. Below: regions of 50 and 90 % of the mass, few points."""
    d = chain.samples.shape[2]
    size = max(4.0, min(12.0, 1.55 * d + 0.8))
    fig, axes = plt.subplots(d, d, figsize=(size, size), squeeze=False, sharex="col")
    low, high = np.quantile(chain.pooled, [0.001, 0.999], axis=0)
    margin = 0.05 * np.where(high > low, high - low, 1)
    low, high = low - margin, high + margin
    few = chain.pooled[:: max(1, len(chain.pooled) // 2000)]
    for i in range(d):
        for j in range(d):
            ax = axes[i, j]
            if j > i:
                ax.axis("off")
                continue
            ax.set_xlim(low[j], high[j])
            ax.tick_params(labelsize=7)
            ax.xaxis.set_major_locator(plt.MaxNLocator(3))
            if i == d - 1:
                ax.set_xlabel(chain.names[j])
                ax.tick_params(axis="x", rotation=45)
            if i == j:
                x = chain.pooled[:, i]
                ax.hist(x, bins=60, range=(low[i], high[i]), density=True, color=BLUE, alpha=0.6)
                for value, style in zip(np.quantile(x, [0.05, 0.5, 0.95]), ("--", "-", "--")):
                    ax.axvline(value, color=ORANGE, lw=1, ls=style)
                ax.set_yticks([])
                ax.set_title("{1:.4g}  [{0:.4g}, {2:.4g}]".format(*np.quantile(x, [0.05, 0.5, 0.95])), fontsize=7)
                continue
            ax.set_ylim(low[i], high[i])
            ax.yaxis.set_major_locator(plt.MaxNLocator(3))
            ax.plot(few[:, j], few[:, i], ".", ms=1, color=GREY, alpha=0.3, rasterized=True)
            counts, xs, ys = np.histogram2d(chain.pooled[:, j], chain.pooled[:, i], bins=36,
                                            range=((low[j], high[j]), (low[i], high[i])))
            counts = smooth(counts)
            levels = levels_of(counts, (0.5, 0.9))
            if len(levels) == 2 and levels[0] > 0:
                ax.contour((xs[1:] + xs[:-1]) / 2, (ys[1:] + ys[:-1]) / 2, counts.T, levels=levels, colors=BLUE,
                           linewidths=(0.8, 1.4))
            if j > 0:
                ax.tick_params(labelleft=False)
            else:
                ax.set_ylabel(chain.names[i])
    fig.suptitle(f"{chain.title()}\nmedian and 90 % interval; contours hold 50 and 90 % of the samples", fontsize=9)
    fig.align_labels()
    fig.tight_layout(h_pad=0.2, w_pad=0.2)
    return fig


def correlation(chain):
    d = len(chain.names)
    with np.errstate(invalid="ignore", divide="ignore"):
        matrix = np.atleast_2d(np.corrcoef(chain.pooled.T))
    fig, ax = plt.subplots(figsize=(max(3.6, 0.62 * d + 1.6), max(3.0, 0.62 * d + 0.9)), layout="constrained")
    image = ax.imshow(matrix, cmap="RdBu_r", vmin=-1, vmax=1)
    for i in range(d):
        for j in range(d):
            ax.text(j, i, f"{matrix[i, j]:.2f}", ha="center", va="center", fontsize=8,
                    color="white" if abs(matrix[i, j]) > 0.6 else "black")
    ax.set_xticks(range(d), chain.names, rotation=45, ha="right")
    ax.set_yticks(range(d), chain.names)
    fig.colorbar(image, label="correlation of the samples")
    return fig


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("chain", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder, default: that of the chain")
    arguments = parser.parse_args()
    chain = Chain(arguments.chain)
    folder = arguments.output or arguments.chain.parent
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in (("trace", trace), ("pairs", pairs), ("correlation", correlation)):
        figure = draw(chain)
        figure.savefig(folder / f"{name}.png")
        plt.close(figure)
        print(folder / f"{name}.png")


main()

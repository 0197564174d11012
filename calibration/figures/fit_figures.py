#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a fit: curves with bands, marginals and pairs, traces. Usage: fit_figures.py FOLDER/fit.h5 [-o DIR]"""
import argparse
import pathlib

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

BLUE, ORANGE, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#555555"
plt.rcParams.update({"font.size": 9, "savefig.dpi": 150, "legend.frameon": False})
LABELS = {
    "deviatoric_stress": ("$q$ / kPa", 1e-3), "axial_stress": (r"$\sigma_a$ / kPa", 1e-3),
    "radial_stress": (r"$\sigma_r$ / kPa", 1e-3), "mean_stress": ("$p$ / kPa", 1e-3), "stress_ratio": ("$q/p$", 1),
    "volumetric_strain": (r"$\varepsilon_v$ / % (contraction up)", 100), "void_ratio": ("$e$", 1),
    "pore_pressure": (r"$\Delta u$ / kPa", 1e-3)}
SYMBOLS = {"phi": r"$\phi$ / deg", "e_ref": r"$e_{ref}$", "A_d": "$A_d$", "k_p": "$k_p$", "n_p": "$n_p$", "n_d": "$n_d$",
           "K0": "$K_0$", "nu": r"$\nu$", "n": "$n$", "lambda": r"$\lambda$", "zeta": r"$\zeta$",
           "model_error_stress_ratio": "model error $q/p$", "model_error_volumetric_strain": r"model error $\varepsilon_v$"}


def text(item, name):
    """An attribute that is a text; fixed-length ones arrive as bytes."""
    value = item.attrs[name]
    return value.decode() if isinstance(value, bytes) else str(value)


def symbol(name):
    return SYMBOLS.get(name, name.replace("_", " "))


def curves_figure(file, out):
    """One row of panels for each measure, one column for each test."""
    curves = [file["curves"][k] for k in sorted(file["curves"])]
    tests = list(dict.fromkeys(text(c, "test") for c in curves))
    measures = list(dict.fromkeys(text(c, "measure") for c in curves))
    fig, axes = plt.subplots(len(measures), len(tests), figsize=(2.4 * len(tests) + 0.6, 2.3 * len(measures) + 0.5),
                             sharex="col", sharey="row", squeeze=False)
    for c in curves:
        ax = axes[measures.index(text(c, "measure"))][tests.index(text(c, "test"))]
        label, factor = LABELS[text(c, "measure")]
        strain = 100 * np.abs(c["axial_strain"][:])
        if "lower" in c:
            ax.fill_between(strain, factor * c["lower"][:], factor * c["upper"][:], color=BLUE, alpha=0.15, lw=0,
                            label="90 % of measured values")
            ax.fill_between(strain, factor * c["model_lower"][:], factor * c["model_upper"][:], color=BLUE, alpha=0.4,
                            lw=0, label="90 % of model curves")
        dense = len(strain) > 150
        ax.plot(strain, factor * c["measured"][:], "-" if dense else ".", color=GREY, lw=0.6, ms=3, label="measured")
        ax.plot(strain, factor * c["best"][:], color=ORANGE, lw=1.3, label="best fit")
        if "material" in c:
            ax.plot(strain, factor * c["material"][:], "--", color=GREEN, lw=0.9, label="material file")
        if ax in axes[:, 0]:
            ax.set_ylabel(label)
        if ax in axes[0]:
            ax.set_title(text(c, "test") + ("\n(held out)" if c.attrs["held_out"] else ""), fontsize=9)
    for ax in axes[-1]:
        ax.set_xlabel("axial strain / %")
    handles, labels = axes[0][0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="lower center", ncols=len(handles))
    fig.tight_layout(rect=(0, 0.35 / fig.get_figheight(), 1, 1))
    fig.savefig(out / "fit_curves.png")


def samples_of(file):
    posterior = file["posterior"]
    return text(posterior, "names").split(","), posterior["samples"][:], int(posterior.attrs["walkers"])


def logarithmic(values):
    return values.min() > 0 and np.percentile(values, 99) > 8 * np.percentile(values, 1)


def pairs_figure(file, out):
    """Marginals on the diagonal, samples of each pair below it."""
    names, samples, _ = samples_of(file)
    p = file["parameters"]
    reference = dict(zip(text(p, "names").split(","), p["material"][:]))
    best = dict(zip(text(p, "names").split(","), p["best"][:]))
    n = len(names)
    fig, axes = plt.subplots(n, n, figsize=(1.5 * n + 0.8, 1.5 * n + 0.8), squeeze=False)
    thinned = samples[:: max(1, len(samples) // 3000)]
    # What is outside of the range of the samples would squeeze them: Table values there are not drawn.
    limits = []
    for d in range(n):
        low, high = np.percentile(samples[:, d], [0.1, 99.9])
        margin = 0.08 * (high - low) or 1e-12
        limits.append((low * 0.95, high * 1.05) if logarithmic(samples[:, d]) else (low - margin, high + margin))
    for i in range(n):
        for j in range(n):
            ax = axes[i][j]
            if j > i:
                ax.axis("off")
                continue
            ax.set_xlim(limits[j])
            if logarithmic(samples[:, j]):
                ax.set_xscale("log")
            if i == j:
                edges = (np.geomspace if logarithmic(samples[:, i]) else np.linspace)(*limits[i], 30)
                ax.hist(samples[:, i], edges, color=BLUE, alpha=0.5)
                for value, colour in ((best.get(names[i]), ORANGE), (reference.get(names[i]), GREEN)):
                    if value is not None and limits[i][0] <= value <= limits[i][1]:
                        ax.axvline(value, color=colour, lw=1.2)
                ax.set_yticks([])
            else:
                if logarithmic(samples[:, i]):
                    ax.set_yscale("log")
                ax.set_ylim(limits[i])
                ax.plot(thinned[:, j], thinned[:, i], ",", color=BLUE, alpha=0.5)
                correlation = np.corrcoef(samples[:, i], samples[:, j])[0, 1]
                ax.text(0.04, 0.86, f"{correlation:.2f}", transform=ax.transAxes, fontsize=7)
            ax.tick_params(labelsize=6, which="both")
            ax.tick_params(axis="x", rotation=60)
            if not ax.get_xscale() == "log":
                ax.locator_params(axis="x", nbins=3)
            if i != j and not ax.get_yscale() == "log":
                ax.locator_params(axis="y", nbins=3)
            if i == n - 1:
                ax.set_xlabel(symbol(names[j]), fontsize=8)
            else:
                ax.xaxis.set_ticklabels([])
                ax.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
            if j == 0 and i > 0:
                ax.set_ylabel(symbol(names[i]), fontsize=8)
            elif i != j:
                ax.yaxis.set_ticklabels([])
                ax.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    fig.text(0.62, 0.92, "orange: best fit; green: material file\nnumbers: correlation", fontsize=9)
    fig.tight_layout(h_pad=0.2, w_pad=0.2)
    fig.savefig(out / "fit_pairs.png")


def trace_figure(file, out):
    names, samples, walkers = samples_of(file)
    steps = len(samples) // walkers
    chains = samples.reshape(steps, walkers, len(names))
    fig, axes = plt.subplots(len(names), 1, figsize=(8, 1.1 * len(names) + 0.6), sharex=True, squeeze=False)
    for d, ax in enumerate(axes[:, 0]):
        ax.plot(chains[:, :, d], lw=0.3, alpha=0.5)
        if logarithmic(samples[:, d]):
            ax.set_yscale("log")
        ax.set_ylabel(symbol(names[d]), fontsize=8)
        ax.tick_params(labelsize=7)
    axes[-1][0].set_xlabel("kept step of each walker")
    fig.tight_layout(h_pad=0.2)
    fig.savefig(out / "fit_trace.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fit", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    arguments = parser.parse_args()
    out = arguments.output or arguments.fit.parent
    out.mkdir(parents=True, exist_ok=True)
    with h5py.File(arguments.fit) as file:
        curves_figure(file, out)
        if "posterior" in file:
            pairs_figure(file, out)
            trace_figure(file, out)
    for name in sorted(out.glob("fit_*.png")):
        print(name)


if __name__ == "__main__":
    main()

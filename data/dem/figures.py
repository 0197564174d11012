#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what is in results/: triaxial curves, deposits beside the laboratory's laws, outlines in time, h(t).

    figures.py [OUT [RESULTS]]     OUT: results/dem/figures at the root of the repository

Laws of axisymmetric collapse, a = h0/r0:
  Lube, Huppert, Sparks, Hallworth 2004, J. Fluid Mech. 508:175:
    (r_f - r0)/r0 = 1.24 a (a < 1.7), 1.6 a^(1/2) above; h_f/r0 = a (a < 1), 0.88 a^(1/6)
    (1.7 < a < 10), nothing between
  Lajeunesse, Mangeney-Castelnau, Vilotte 2004, Phys. Fluids 16:2371:
    h_f/r0 = a (a < 0.74), 0.74 above; 2 a^(1/2) above 0.74, quoted as (r_f - r0)/r0 and as
    r_f/r0: both are drawn; a cone of height 0.74 r0 keeps the volume with the second only
"""
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from summary import friction_angle, read_triaxial

COLOUR = {"SS": "tab:blue", "TS": "tab:red", "ES": "tab:green"}
MARKER = {"dense": "o", "loose": "s"}
LINE = {"dense": "-", "loose": "--"}


def lube_height(a):
    return np.where(a < 1, a, np.where(a > 1.7, 0.88 * a ** (1 / 6), np.nan))


def lube_runout(a):
    return np.where(a < 1.7, 1.24 * a, 1.6 * np.sqrt(a))


def centred_mean(x, n):
    """Mean over n neighbours on either side, over fewer, as many on both, towards the ends."""
    total = np.concatenate([[0], np.cumsum(x)])
    k = np.arange(len(x))
    reach = np.minimum(n, np.minimum(k, k[::-1]))
    return (total[k + reach + 1] - total[k - reach]) / (2 * reach + 1)


def main_set(results, pattern):
    """Result files of the first seed and the standard parameters."""
    return [p for p in sorted(results.glob(pattern)) if len(p.stem.split("_")) == 4]


def draw_triaxial(results, out):
    paths = main_set(results, "triaxial_*.csv")
    if not paths:
        return
    fig, axes = plt.subplots(2, 3, figsize=(12, 7), sharex=True, sharey="row", layout="constrained")
    for path in paths:
        header, t = read_triaxial(path)
        shape, packing = header["shape"], header["packing"]
        column = ["SS", "TS", "ES"].index(shape)
        shade = {"10000": 1.0, "5000": 0.65, "2000": 0.4}.get(header["confining_pressure_Pa"], 0.5)
        style = dict(color=COLOUR[shape], alpha=shade, ls=LINE[packing], lw=1.2)
        x = 100 * t["axial_strain"]
        phi = friction_angle(centred_mean(t["sigma_axial_Pa"], 10), centred_mean(t["sigma_radial_Pa"], 10))
        label = f"{packing}, {float(header['confining_pressure_Pa']) / 1e3:g} kPa"
        axes[0, column].plot(x, phi, **style, label=label)
        axes[1, column].plot(x, t["void_ratio"], **style)
    for k, shape in enumerate(("SS", "TS", "ES")):
        axes[0, k].set_title(shape)
        if axes[0, k].lines:
            axes[0, k].legend(fontsize=7)
        axes[1, k].set_xlabel("axial strain, logarithmic [%]")
        for ax in axes[:, k]:
            ax.grid(alpha=0.3)
    axes[0, 0].set_ylabel("mobilised friction angle [deg]\n(mean over 1 % strain)")
    axes[1, 0].set_ylabel("void ratio")
    fig.savefig(out / "triaxial.png", dpi=120)


def draw_laws(results, out):
    fig, axes = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    a = np.linspace(0.2, 4.4, 400)
    axes[0].plot(a, lube_height(a), "k-", label="Lube et al. 2004")
    axes[0].plot(a, np.minimum(a, 0.74), "k--", label="Lajeunesse et al. 2004")
    axes[1].plot(a, lube_runout(a), "k-", label="Lube et al. 2004")
    high = a[a > 0.74]
    axes[1].plot(high, 2 * np.sqrt(high), "k--", label="Lajeunesse et al. 2004, as $(r_f-r_0)/r_0$")
    axes[1].plot(high, 2 * np.sqrt(high) - 1, "k:", label="the same, as $r_f/r_0$")
    for path in main_set(results, "column_*.h5"):
        with h5py.File(path) as f:
            shape, packing, r0 = f.attrs["shape"], f.attrs["packing"], f.attrs["radius_m"]
            style = dict(color=COLOUR[shape], marker=MARKER[packing], ls="")
            style["mfc"] = "none" if packing == "loose" else COLOUR[shape]
            x = f.attrs["aspect_ratio"] * (1 if packing == "dense" else 1.03)
            axes[0].plot(x, f["height/surface"][-1] / r0, **style, label=f"DEM {shape} {packing}")
            ends = [f["front/" + k][-1] / r0 - 1 for k in ("one_grain", "cluster", "mass95")]
            axes[1].plot(x, ends[0], **style)
            axes[1].plot([x, x], [min(ends), min(max(ends), 4.5)], color=COLOUR[shape], lw=0.8, alpha=0.5)
    axes[0].set_ylabel("$h_f/r_0$ (surface within 9 mm of the axis)")
    axes[1].set_ylabel("$(r_f-r_0)/r_0$ (one grain high; bar: cluster, 95 % of mass)")
    for ax in axes:
        ax.set_xlabel("aspect ratio")
        handles = dict(zip(*reversed(ax.get_legend_handles_labels())))
        ax.legend(handles.values(), handles.keys(), fontsize=8, ncols=2, loc="lower right")
        ax.grid(alpha=0.3)
    axes[1].set_ylim(0, 4.5)
    fig.savefig(out / "laws.png", dpi=120)


def draw_outlines(results, out, aspect_ratio):
    """Outlines in time of the six columns of one aspect ratio, DEM's figures 5 and 6 of the paper."""
    fig, axes = plt.subplots(2, 3, figsize=(13, 6), sharex=True, sharey=True, layout="constrained")
    for path in main_set(results, f"column_*_{aspect_ratio}.h5"):
        with h5py.File(path) as f:
            shape, packing, r0 = f.attrs["shape"], f.attrs["packing"], f.attrs["radius_m"]
            ax = axes[["dense", "loose"].index(packing), ["SS", "TS", "ES"].index(shape)]
            t, r = f["time"][:], f["outline/radius"][:]
            for k in sorted({np.abs(t - moment).argmin() for moment in (0, 0.05, 0.1, 0.15, 0.2, 0.3, t[-1])}):
                colour = plt.cm.viridis(min(1.0, t[k] / 0.4))
                ax.plot(r / r0, f["outline/height"][k] / r0, color=colour, label=f"{t[k]:.2f} s")
            ax.legend(fontsize=8)
    for (row, column), ax in np.ndenumerate(axes):
        shape, packing = ("SS", "TS", "ES")[column], ("dense", "loose")[row]
        ax.set_title(f"{shape} {packing}" + ("" if ax.lines else ": missing"))
        ax.set(xlim=(0, 4), ylim=(0, 1.1 * aspect_ratio))
        ax.grid(alpha=0.3)
    fig.supxlabel("$r/r_0$")
    fig.supylabel("highest grain surface over $r_0$, mean of cells of two diameters")
    fig.savefig(out / f"outlines_a{aspect_ratio}.png", dpi=100)
    plt.close(fig)


def draw_column(path, out):
    """Outlines in time, height and fronts, displacement where the grains ended."""
    with h5py.File(path) as f:
        r0, t, r = f.attrs["radius_m"], f["time"][:], f["outline/radius"][:]
        fig, axes = plt.subplots(1, 3, figsize=(15, 4.2), layout="constrained")
        for k in sorted({np.abs(t - moment).argmin() for moment in (0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, t[-1])}):
            colour = plt.cm.viridis(t[k] / t[-1])
            axes[0].plot(r / r0, f["outline/height"][k] / r0, color=colour, label=f"{t[k]:.2f} s")
        axes[0].set(xlabel="$r/r_0$", ylabel="$z/r_0$", xlim=(0, 4), title="outlines")
        axes[0].legend(fontsize=7)
        for name in ("surface", "highest"):
            axes[1].plot(t, f["height/" + name][:] / r0, label="height, " + name)
        for name in ("one_grain", "cluster", "mass95", "mass99"):
            axes[1].plot(t, f["front/" + name][:] / r0 - 1, "--", label="runout, " + name)
        axes[1].set(xlabel="time [s]", ylabel="$h/r_0$, $(r-r_0)/r_0$", ylim=(0, 3))
        axes[1].legend(fontsize=7)
        u = f["displacement/final_u"][:]
        levels = (np.arange(u.shape[0] + 1)) * (r[1] - r[0]) / r0
        edges = np.arange(u.shape[1] + 1) * (r[1] - r[0]) / r0
        image = axes[2].pcolormesh(edges, levels, u / r0, vmin=0, vmax=1.5, cmap="turbo")
        axes[2].set(xlabel="$r/r_0$", ylabel="$z/r_0$", xlim=(0, 4))
        axes[2].set_title("displacement$/r_0$ where the grains ended")
        fig.colorbar(image, ax=axes[2])
        fig.suptitle(path.stem)
        fig.savefig(out / (path.stem + ".png"), dpi=110)
        plt.close(fig)


def main():
    here = pathlib.Path(__file__).parent
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "../../results/dem/figures"
    results = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else here / "results"
    out.mkdir(parents=True, exist_ok=True)
    draw_triaxial(results, out)
    draw_laws(results, out)
    draw_outlines(results, out, 2)
    for path in sorted(results.glob("column_*.h5")):
        draw_column(path, out)


if __name__ == "__main__":
    main()

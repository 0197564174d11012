#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of element tests. Usage: element_figures.py TABLE.csv ... -o FOLDER

Tables are those of `simsand element` (columns: drivers/element/ELEMENT.md); all of them go into each picture. Beside
NAME.csv the table NAME_envelope.csv, if there is one, is drawn as well. `--critical PHI E_REF LAMBDA ZETA P_AT P_MIN`
(degrees, Pa), once per table, draws the whole critical state line; without it only the part that the test visits.
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures.style import COLOURS, plt, use
from figures.table import read_columns
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

use(font_size=10, dpi=160, **{"axes.grid": True, "grid.color": "0.9"})


class Test:
    """A table, its style, and what the pictures show of it. Stress in kPa, strain in per cent."""

    def __init__(self, path, critical, colour):
        self.name, self.colour = pathlib.Path(path).stem, colour
        self.data = read_columns(path)
        self.critical = critical if critical and np.isfinite(critical).all() else None
        self.p = self.data["p_Pa"] / 1e3
        self.e = self.data.get("void_ratio")
        self.axial, self.volumetric = 100 * self.data["strain_11"], 100 * self.data["volumetric_strain"]
        self.gamma, self.tau = 200 * self.data["strain_12"], self.data["stress_12_Pa"] / 1e3
        self.sheared = np.ptp(self.gamma) > np.ptp(self.axial)
        # Signed where the state is axisymmetric all along, so that extension lies below the axis.
        d = self.data
        off = np.abs(d["stress_22_Pa"] - d["stress_33_Pa"]) + np.abs(d["stress_12_Pa"])
        self.signed = bool((off <= 1e-6 * np.abs(d["stress_11_Pa"]) + 1e-9).all())
        self.q = (d["deviator_Pa"] if self.signed else d["q_Pa"]) / 1e3
        envelope = pathlib.Path(path).with_name(self.name + "_envelope.csv")
        self.envelope = read_columns(envelope) if envelope.exists() else None

    def line(self, ax, x, y, **style):
        ax.plot(x, y, color=self.colour, lw=1.6, label=self.name, **style)
        if len(x):
            ax.plot(x[0], y[0], "o", color=self.colour, ms=4)

    def slopes(self):
        """M in triaxial compression and, with a minus sign, extension."""
        if self.critical:
            sine = np.sin(np.radians(self.critical[0]))
            return 6 * sine / (3 - sine), -6 * sine / (3 + sine)
        m, lode = self.data.get("critical_stress_ratio"), self.data["lode_angle_deg"]
        if m is None:
            return None, None
        found = [m[np.abs(lode - angle) < 0.1] for angle in (-30, 30)]
        return tuple(sign * f[-1] if f.size else None for sign, f in zip((1, -1), found))

    def critical_line(self, low, high):
        """Mean stress (kPa) and critical void ratio."""
        if self.critical:
            _, e_ref, slope, zeta, p_at, p_min = self.critical
            p = np.geomspace(low, high, 200)
            return p, np.maximum(e_ref - slope * (np.maximum(1e3 * p, p_min) / p_at) ** zeta, 0.01)
        if "critical_void_ratio" not in self.data:
            return None
        order = np.argsort(self.p)
        return self.p[order], self.data["critical_void_ratio"][order]


def hide_rounding(ax, values, scale):
    """Keeps a quantity that is zero but for rounding errors from filling the axis."""
    if max(np.abs(v).max() for v in values) < 1e-6 * scale:
        ax.set_ylim(-0.1 * scale, 0.1 * scale)


def deviator(ax, tests):
    sheared = all(t.sheared for t in tests)
    for t in tests:
        t.line(ax, t.gamma if sheared else t.axial, t.tau if sheared else t.q)
    hide_rounding(ax, [t.tau if sheared else t.q for t in tests], max(np.abs(t.p).max() for t in tests))
    ax.set_xlabel(r"shear strain $\gamma$ / %" if sheared else r"axial strain $\varepsilon_a$ / %")
    ax.set_ylabel(r"shear stress $\tau$ / kPa" if sheared else "deviatoric stress $q$ / kPa")


def volume(ax, tests):
    sheared = all(t.sheared for t in tests)
    for t in tests:
        t.line(ax, t.gamma if sheared else t.axial, t.volumetric)
    hide_rounding(ax, [t.volumetric for t in tests], 10)
    ax.set_xlabel(r"shear strain $\gamma$ / %" if sheared else r"axial strain $\varepsilon_a$ / %")
    ax.set_ylabel(r"volumetric strain $\varepsilon_v$ / %" "\n(compression positive)")


def stress_path(ax, tests):
    top = 1.05 * max(t.p.max() for t in tests)
    drawn = set()
    for t in tests:
        t.line(ax, t.p, t.q)
        for slope in t.slopes():
            if slope and (slope > 0 or t.q.min() < -1e-3 * t.p.max()) and slope not in drawn:
                drawn.add(slope)
                ax.plot([0, top], [0, slope * top], "--", color=t.colour, lw=1)
    if drawn:
        ax.plot([], [], "--", color="0.4", lw=1, label="critical state")
    ax.set_xlim(0, top)
    low, high = min(0, *(t.q.min() for t in tests)), max(0, *(t.q.max() for t in tests))
    if high - low > 1e-6 * top:
        ax.set_ylim(1.08 * low, 1.08 * high)
    else:
        ax.set_ylim(-0.1 * top, top)
    ax.set_xlabel("mean effective stress $p$ / kPa")
    ax.set_ylabel("deviatoric stress $q$ / kPa")


def void_ratio(ax, tests):
    tests = [t for t in tests if t.e is not None]
    if not tests:
        raise ValueError("no table has a void ratio")
    positive = np.concatenate([t.p[t.p > 0] for t in tests])
    low, high = positive.min() / 1.5, positive.max() * 1.5
    drawn = False
    for t in tests:
        t.line(ax, np.where(t.p > 0, t.p, np.nan), t.e)
        if (csl := t.critical_line(low, high)) is not None:
            ax.plot(*csl, "--", color=t.colour, lw=1)
            drawn = True
    if drawn:
        ax.plot([], [], "--", color="0.4", lw=1, label="critical state")
    ax.set_xscale("log")
    ax.set_xlim(low, high)
    if high < 30 * low:  # within a decade or so: 1, 2, 5
        ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.xaxis.set_minor_formatter(NullFormatter())
    ax.xaxis.set_major_formatter(lambda p, _: f"{p:g}")
    ax.set_xlabel("mean effective stress $p$ / kPa")
    ax.set_ylabel("void ratio $e$")


def pore_pressure(ax, tests):
    tests = [t for t in tests if np.any(t.data["pore_pressure_ratio"])]
    if not tests:
        return False
    sheared = all(t.sheared for t in tests)
    for t in tests:
        t.line(ax, t.gamma if sheared else t.axial, t.data["pore_pressure_Pa"] / 1e3)
    ax.set_xlabel(r"shear strain $\gamma$ / %" if sheared else r"axial strain $\varepsilon_a$ / %")
    ax.set_ylabel("pore pressure $u$ / kPa")
    return True


def envelopes(ax, tests):
    """Rendulic plane: axial stress against sqrt(2) times radial stress."""
    tests = [t for t in tests if t.envelope is not None]
    if not tests:
        return False
    root, top = np.sqrt(2), 0.0
    for t in tests:
        d, v = t.data, t.envelope
        ax.plot(root * d["stress_22_Pa"] / 1e3, d["stress_11_Pa"] / 1e3, color="0.6", lw=1)
        for stage in np.unique(v["stage"]):
            at = v["stage"] == stage
            x, y = root * v["stress_22_Pa"][at] / 1e3, v["stress_11_Pa"][at] / 1e3
            ax.plot(np.append(x, x[0]), np.append(y, y[0]), color=t.colour, lw=1.6,
                    label=t.name if stage == v["stage"][0] else None)
            start = [(s - c)[0] / 1e3 for s, c in ((root * v["stress_22_Pa"][at], root * v["stress_change_22_Pa"][at]),
                                                   (v["stress_11_Pa"][at], v["stress_change_11_Pa"][at]))]
            ax.plot(*start, "o", color=t.colour, ms=4)
            top = max(top, x.max(), y.max())
    top *= 1.05
    ax.plot([0, root * top], [0, top], ":", color="0.4", lw=1, label="isotropic")
    for t in tests:
        for slope in t.slopes():  # q = M p with p = (s_a + 2 s_r) / 3, q = s_a - s_r
            if slope:
                radial = 3 * top * (1 - slope / 3) / (3 + 2 * slope)
                ax.plot([0, root * radial], [0, top], "--", color=t.colour, lw=1)
    ax.set_aspect("equal")
    ax.set_xlim(0, top)
    ax.set_ylim(0, top)
    ax.set_xlabel(r"$\sqrt{2}\,\sigma_r$ / kPa")
    ax.set_ylabel(r"$\sigma_a$ / kPa")
    return True


def legend(ax, tests):
    if len(tests) > 1 or ax.get_legend_handles_labels()[1][1:]:
        ax.legend(fontsize=8)


def single(draw, tests, path):
    fig, ax = plt.subplots(figsize=(6, 4.4))
    if draw(ax, tests) is not False:
        legend(ax, tests)
        fig.savefig(path, bbox_inches="tight")
        print(path)
    plt.close(fig)


def overview(tests, path):
    fig, axes = plt.subplots(2, 2, figsize=(10, 7.6))
    for ax, draw in zip(axes.flat, (deviator, stress_path, volume, void_ratio)):
        try:
            draw(ax, tests)
        except ValueError as error:
            ax.text(0.5, 0.5, str(error), ha="center", transform=ax.transAxes)
    handles, labels = axes[0, 1].get_legend_handles_labels()
    rows = -(-len(labels) // 4) if len(labels) > 1 else 0
    if rows:
        fig.legend(handles, labels, loc="lower center", ncols=4, fontsize=9)
    fig.align_ylabels()
    fig.tight_layout(rect=(0, 0.035 * rows, 1, 1))
    fig.savefig(path)
    print(path)
    plt.close(fig)


def main():
    parser = argparse.ArgumentParser(description="Pictures of element tests.")
    parser.add_argument("tables", nargs="+", help="tables of `simsand element`, .csv")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="folder of the pictures")
    parser.add_argument("--critical", type=float, nargs=6, action="append", default=[],
                        metavar=("PHI", "E_REF", "LAMBDA", "ZETA", "P_AT", "P_MIN"), help="once per table")
    arguments = parser.parse_args()
    if arguments.critical and len(arguments.critical) != len(arguments.tables):
        parser.error("--critical: expected once per table")
    critical = arguments.critical or [None] * len(arguments.tables)
    tests = []
    for number, (path, numbers) in enumerate(zip(arguments.tables, critical)):
        try:
            tests.append(Test(path, numbers, COLOURS[number % len(COLOURS)]))
        except (OSError, ValueError, KeyError) as error:
            sys.exit(f"{path}: not a table of simsand element: {error}".replace("\n", " "))
    failed = False
    try:
        arguments.output.mkdir(parents=True, exist_ok=True)
        overview(tests, arguments.output / "overview.png")
    except OSError as error:
        sys.exit(f"{arguments.output}: {error}")
    for draw in (deviator, volume, stress_path, void_ratio, pore_pressure, envelopes):
        path = arguments.output / f"{draw.__name__}.png"
        try:
            single(draw, tests, path)
        except (OSError, ValueError, KeyError) as error:
            print(f"{path}: not drawn: {error}".replace("\n", " "), file=sys.stderr)
            failed = failed or draw is not void_ratio
    sys.exit(int(failed))


if __name__ == "__main__":
    main()

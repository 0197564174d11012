# SPDX-License-Identifier: BSD-3-Clause
"""The trends that the paper reports, judged on any columns: runs or discrete elements. A difference within the scatter
of single runs counts as equal, and as neither holding nor failing."""
import numpy as np

from figures.study_data import ASPECTS, PACKINGS, SHAPES, fallen, undisturbed

SCATTER = {"height": 0.01, "runout": 0.05, "undisturbed": 0.005}  # README: equal runs that differ in the step alone
# Shape of the undisturbed zone (zone_shape). Its radius near the top (at nine tenths of its height) over that at the floor
# tells a trapezoid from a cone; the part of the deposit above its top tells what is buried.
TRAPEZOID, BURIED = 1 / 3, 0.4  # a paraboloid has 0.32, a cone 0.1


class Trend:
    """Counts of cases; the exceptions with their numbers."""

    def __init__(self, name):
        self.name, self.holds, self.equal, self.fails, self.exceptions = name, 0, 0, 0, []

    def add(self, case, value, scatter=0.0):
        """The trend holds for a case where the value is positive."""
        if not np.isfinite(value):
            return
        if abs(value) < scatter:
            self.equal += 1
        elif value > 0:
            self.holds += 1
        else:
            self.fails += 1
            self.exceptions.append(f"{case} ({value:+.3f})")

    def row(self):
        return {"trend": self.name, "holds": self.holds, "equal": self.equal, "fails": self.fails,
                "exceptions": "; ".join(self.exceptions)}


def zone_shape(body):
    """Of the undisturbed zone: height over that of the column, radius near the top over that at the floor, and the
    share of the deposit's height that lies above it."""
    z, radius = body.zone()
    half = 0.5 * (z[1] - z[0])
    wide = np.flatnonzero(radius > 0.1 * body.r0)
    if not wide.size:
        return 0.0, np.nan, 1.0
    top = z[wide[-1]] + half
    slope = np.interp(0.9 * top, z, radius) / radius[0]
    return min(1.0, top / body.h0), slope, 1 - min(1.0, top / (body.height * body.r0))


def packing_trends(columns):
    higher, shorter, larger = Trend("dense higher than loose"), Trend("dense shorter runout than loose"), \
        Trend("dense undisturbed zone larger than loose")
    for shape in SHAPES:
        for a in ASPECTS:
            dense, loose = columns.get((shape, "dense", a)), columns.get((shape, "loose", a))
            if dense and loose:
                case = f"{shape} a = {a:g}"
                higher.add(case, dense.height - loose.height, SCATTER["height"])
                shorter.add(case, loose.runout - dense.runout, SCATTER["runout"])
                larger.add(case, undisturbed(dense) - undisturbed(loose), SCATTER["undisturbed"])
    return [higher, shorter, larger]


def shape_trends(columns):
    lowest, furthest = Trend("SS lowest"), Trend("SS furthest")
    alike = {name: Trend(f"TS and ES alike in {name}: apart by less than half their distance to SS")
             for name in ("height", "runout")}
    for packing in PACKINGS:
        for a in ASPECTS:
            three = [columns.get((shape, packing, a)) for shape in SHAPES]
            if not all(three):
                continue
            ss, ts, es = three
            case = f"{packing} a = {a:g}"
            lowest.add(case, min(ts.height, es.height) - ss.height, SCATTER["height"])
            furthest.add(case, ss.runout - max(ts.runout, es.runout), SCATTER["runout"])
            for name, trend in alike.items():
                s, t, e = (getattr(body, name) for body in (ss, ts, es))
                apart, distance = abs(t - e), abs(0.5 * (t + e) - s)
                trend.add(case, 0.5 * distance - apart, SCATTER[name] if max(apart, distance) < SCATTER[name] else 0)
    return [lowest, furthest, *alike.values()]


def zone_trends(columns):
    flat, cone, open_top, buried = Trend("undisturbed zone trapezoidal at a = 0.5"), \
        Trend("undisturbed zone conical at a = 1 and 2"), \
        Trend("undisturbed zone not buried at a = 1 and 2"), Trend("undisturbed zone buried at a = 4")
    for (shape, packing, a), body in columns.items():
        _, slope, cover = zone_shape(body)
        case = f"{shape} {packing} a = {a:g}"
        if a == 0.5:
            flat.add(case, slope - TRAPEZOID if np.isfinite(slope) else -TRAPEZOID)
        elif a < 4:
            cone.add(case, TRAPEZOID - slope if np.isfinite(slope) else -TRAPEZOID)
            open_top.add(case, BURIED - cover)
        else:
            buried.add(case, cover - BURIED)
    return [flat, cone, open_top, buried]


def phase_trend(columns):
    """The first and the last twentieth of the fall are slow: each has less than half the mean speed between."""
    trend = Trend("three phases: the fall begins slowly, is fast, and ends slowly")
    for (shape, packing, a), body in columns.items():
        begin, end = (fallen(body.time, body.heights, share) for share in (0.05, 0.95))
        standing = fallen(body.time, body.heights, 0.999)
        if np.isfinite(begin):
            fast = 0.9 / (end - begin)
            slowest = min(fast * begin / 0.05, fast * (standing - end) / 0.05)
            trend.add(f"{shape} {packing} a = {a:g}", slowest - 2)
    return trend


def trends(columns):
    found = [*packing_trends(columns), *shape_trends(columns), *zone_trends(columns), phase_trend(columns)]
    return [trend.row() for trend in found]

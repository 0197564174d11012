#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables, pictures and the page of `simsand study columns`.

    study_columns.py FOLDER --data DATA   FOLDER/SPACINGmm/SET/COLUMN/result.h5 -> FOLDER/*.csv, *.png, index.html

Pictures follow the paper of Jin, Lu and Yang: its Figs. 4 (fields at a = 2), 5 and 6 (outlines in time), 7 (height in
time), 8 and 9 (deposits beside the laws), 10 (final fields of all columns)."""
import argparse
import html
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures import study_pictures as pictures
from figures.study_data import finest, read_dem, read_laws, read_runs
from figures.study_discussion import against_dem, against_laws, between_sets, simpler, spent, thrown, why
from figures.study_page import PAGE, bullets, embedded, page_table, save, text_bullets, text_table
from figures.style import plt
from figures.study_rows import cost_rows, dem_rows, rows_of
from figures.study_trends import trends
from figures.table import write_rows

MAIN = {"dem": "Parameters calibrated on DEM triaxial tests", "table4": "Parameters of the paper's Table 4"}
OTHERS = {"literal": "Sensitivity: Table 2 read literally, the printed porosity as void ratio (Table 4)",
          "dem_packing": "Sensitivity: the void ratio of the DEM columns in place of Table 2's (calibrated)",
          "drucker_prager": "The simpler model: Drucker-Prager, critical friction angle of the calibrated set, no dilation"}
SHORT = ("shape", "packing", "a", "void_ratio", "height", "dem_height", "height_error_%", "runout", "dem_runout",
         "radius_error_%", "mass95_error_%", "outline_distance_%", "time_to_rest_s", "fall_95_s", "dem_fall_95_s", "undisturbed",
         "dem_undisturbed", "undisturbed_cm3", "Lube 2004 height", "Lajeunesse 2004 height", "Lube 2004 runout",
         "Lajeunesse 2004, second reading runout", "cpu_s", "dem_cost_over_ours")
COST = ("set", "spacing_mm", "columns", "columns_with_dem", "mean_height_error_%", "mean_radius_error_%", "to_1mm_height_%",
        "to_1mm_radius_%", "to_2mm_height_%", "to_2mm_radius_%", "cpu_s_all", "median_dem_cost_over_ours",
        "median_dem_collapse_over_ours")
INTRO = """Axisymmetric SPH with SIMSAND, beside discrete elements (DEM) of the same grains and the laws of Lube et al. (2004) and
Lajeunesse et al. (2004). Heights and runouts over the initial radius of 50 mm; the front is where the deposit is one
grain, 2.95 mm, high. Errors are of SPH against DEM. Undisturbed: what moved less than half a grain. Fall 95: when 95 % of the
fall are done. Processor times are of one core."""


class Study:
    """The runs of a folder, and what they are compared with."""

    def __init__(self, folder, data):
        self.folder, self.runs = folder, read_runs(folder)
        self.dem, self.laws = read_dem(data), read_laws(data)
        self.shown = {name: finest(self.runs, name) for name in (*MAIN, *OTHERS)}
        self.shown = {name: found for name, found in self.shown.items() if found[1]}
        self.rows = {name: rows_of(columns, self.dem, self.laws) for name, (_, columns) in self.shown.items()}
        self.costs = cost_rows(self.runs, self.dem, self.laws)
        self.text = ""  # the same report in Markdown

    def alike(self, first, second):
        """Rows of two sets at one spacing: that with most columns in both, the finest of those."""
        spacings = {spacing for _, spacing in self.runs}
        common = {spacing: self.runs.get((first, spacing), {}).keys() & self.runs.get((second, spacing), {}).keys()
                  for spacing in spacings}
        spacing = min(spacings, key=lambda s: (-len(common[s]), s))
        return spacing, [rows_of({key: run for key, run in self.runs.get((name, spacing), {}).items()
                                  if key in common[spacing]}, self.dem, self.laws) for name in (first, second)]

    def title(self, title, level=2):
        self.text += f"\n{'#' * level} {title}\n\n"
        return f"<h{level}>{html.escape(title)}</h{level}>"

    def sentences(self, lines):
        self.text += text_bullets(lines)
        return bullets(lines)

    def table(self, rows, names=None):
        self.text += "\n" + text_table(rows, names)
        return page_table(rows, names)

    def picture(self, name, caption, fig, dpi=110):
        if fig is None:
            return ""
        path = self.folder / f"{name}.png"
        save(fig, path, dpi)
        plt.close(fig)
        self.text += f"\n![{caption}]({name}.png)\n\n"
        return embedded(path, caption)


def overview(study):
    """Sets side by side: deposits, errors, trends, cost."""
    families = [("DEM (Fig. 8)", study.dem)] if study.dem else []
    families += [(f"{pictures.NAMES[name]}, {study.shown[name][0]:g} mm (Fig. 9)", study.shown[name][1])
                 for name in MAIN if name in study.shown]
    body = study.title("Side by side") + study.picture(
        "deposits", "Figs. 8 and 9: final height and runout, DEM and SPH, with the laws", pictures.deposits(families, study.laws))
    body += study.picture("errors", "Errors of SPH against DEM, column by column", pictures.errors(
        [(f"{pictures.NAMES[name]}, {study.shown[name][0]:g} mm", study.rows[name]) for name in study.shown
         if name != "literal"]))
    if all(name in study.shown for name in MAIN):
        spacing, (first, second) = study.alike("table4", "dem")
        body += study.sentences(between_sets(first, second, (f"Table 4 at {spacing:g} mm", "the calibrated set")))
    return body


def trend_part(study):
    rows = []
    for (name, spacing), columns in study.runs.items():
        rows += [{"columns": f"{name}, {spacing:g} mm", **row} for row in trends(columns)]
    rows += [{"columns": "DEM", **row} for row in trends(study.dem)]
    write_rows(study.folder / "trends.csv", rows)
    wanted = [f"{name}, {study.shown[name][0]:g} mm" for name in MAIN if name in study.shown] + ["DEM"]
    return (study.title("The trends of the paper") + "<p>Counts of cases in which a trend holds, differs by less than the scatter of "
            "single runs (equal), or fails; failing cases with the amount by which they do.</p>" +
            study.table([row for row in rows if row["columns"] in wanted and row["holds"] + row["equal"] + row["fails"]]))


def cost_part(study):
    write_rows(study.folder / "cost.csv", study.costs)
    body = study.title("Cost") + study.picture("cost", "Error against processor time at each spacing",
                                           pictures.cost(study.costs))
    for name in MAIN:
        if lines := spent(study.costs, name):
            body += study.title(pictures.NAMES[name], 3) + study.sentences(lines)
    return body + study.table(study.costs, COST)


def fields_of(study, name):
    """Pictures of one set after the paper's figures 4 to 7 and 10."""
    _, runs = study.shown[name]
    body = study.picture(f"{name}_fields", "Fig. 4: final displacement, a = 2, dense",
                         pictures.compared_fields(runs, study.dem))
    body += study.picture(f"{name}_outlines", "Figs. 5 and 6: outlines in time, a = 2, dense",
                          pictures.outlines(runs, study.dem))
    body += study.picture(f"{name}_heights", "Fig. 7: height in time. Grey: 0.05 and 0.40 s, between which the paper sees the "
                          "fall; dotted: 3 sqrt(h0/g), Lube et al.'s time to rest", pictures.heights(runs, study.dem))
    return body + study.picture(f"{name}_all_fields", "Fig. 10: final displacement of all columns; line: undisturbed zone, moved "
                                "less than half a grain", pictures.all_fields(runs), 85)


def like_columns(study, name, base):
    """Rows of another set at the spacing of this one, for the columns it has."""
    spacing, columns = study.shown[name]
    other = study.runs.get((base, spacing), {})
    return rows_of({key: run for key, run in other.items() if key in columns}, study.dem, study.laws)


def set_part(study, name, title):
    rows, (spacing, runs) = study.rows[name], study.shown[name]
    body = study.title(f"{title}, {spacing:g} mm") + study.sentences(against_dem(rows))
    if name in MAIN:
        body += study.title("Why SPH and DEM differ", 3) + study.sentences(why(rows, runs, study.dem) + thrown(runs))
        body += study.title("Beside the laws of the laboratory", 3) + study.sentences(against_laws(rows))
        if study.dem:
            body += study.title("Discrete elements beside the same laws", 3)
            body += study.sentences(against_laws(dem_rows(study.dem, study.laws)))
        body += fields_of(study, name)
    elif name == "drucker_prager":
        body += study.sentences(simpler(rows, like_columns(study, name, "dem")))
    else:
        base = "table4" if name == "literal" else "dem"
        body += study.sentences(between_sets(like_columns(study, name, base), rows, (f"set {base}", f"set {name}")))
    return body + study.table(rows, SHORT)


def main():
    parser = argparse.ArgumentParser(description="Tables, pictures and page of the study of 24 columns.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="data folder of the project")
    arguments = parser.parse_args()
    study = Study(arguments.folder, arguments.data)
    if not study.shown:
        sys.exit(f"{arguments.folder}: expected runs such as 1mm/table4/ss_dense_a1, found none complete")
    body = overview(study) + cost_part(study) + trend_part(study)
    for name, title in {**MAIN, **OTHERS}.items():
        if name in study.shown:
            write_rows(study.folder / f"{name}.csv", study.rows[name])
            body += set_part(study, name, title)
            print(f"{title}, {study.shown[name][0]:g} mm", *against_dem(study.rows[name]), sep="\n  ")
    (study.folder / "report.md").write_text(study.text, encoding="utf-8")
    page = study.folder / "index.html"
    page.write_text(PAGE.format(title="The 24 columns of Jin, Lu and Yang", intro=INTRO, body=body), encoding="utf-8")
    print(page)


if __name__ == "__main__":
    main()

// SPDX-License-Identifier: BSD-3-Clause
// Test curves with little information or with errors: a clear message, or a result that names what is not determined.
#include "calibration/report.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

namespace {

using namespace calibration;

struct Row {
  double strain, q, volume;
};

/// A drained test on dense SS at 10 kPa.
struct Sheet {
  std::vector<Row> rows;
  Specimen specimen{drivers::find_axisymmetric_test("triaxial-drained"), 0.58, 10e3, 10e3, 0.3};
  double q_unit = 1, strain_unit = 1, volume_unit = 1; ///< of a number in the file, SI
};

Sheet good_sheet(int rows) {
  Sheet sheet;
  const auto material = drivers::read_material(
      drivers::parse_toml(fmt::format("file = \"{}/data/materials/SS.toml\"", SIMSAND_SOURCE_DIR), "m", "."),
      0.58);
  Simulator simulator(material, {sheet.specimen});
  const auto path = simulator.run(material.material.properties).front();
  std::vector<double> at(rows), q(rows), volume(rows);
  for (int i = 0; i < rows; ++i) at[i] = 0.3 * std::pow((i + 1.0) / rows, 2);
  interpolate(path, sheet.specimen, Measure::deviatoric_stress, at, q);
  interpolate(path, sheet.specimen, Measure::volumetric_strain, at, volume);
  for (int i = 0; i < rows; ++i) sheet.rows.push_back({at[i], q[i], volume[i]});
  return sheet;
}

struct Files {
  std::string csv, toml;
};

std::string test_table(const std::string& csv, const std::string& more = "") {
  return fmt::format(
      "[[test]]\nname = \"{}\"\nfile = \"{}\"\nkind = \"triaxial-drained\"\nconfining_stress = 10e3\n"
      "{}\n",
      std::filesystem::path(csv).stem().string(), csv, more.empty() ? "void_ratio = 0.58" : more);
}

const char* const columns =
    "[columns.axial_strain]\ncolumn = \"strain\"\nunit = \"%\"\nstrain = \"logarithmic\"\n"
    "[columns.deviatoric_stress]\ncolumn = \"q\"\nunit = \"kPa\"\n"
    "[columns.volumetric_strain]\ncolumn = \"volume\"\nunit = \"%\"\nstrain = \"logarithmic\"\n"
    "positive = \"dilation\"\n";

const char* const all_parameters =
    "[parameter.e_ref]\nlower = 0.4\nupper = 1.2\n[parameter.phi]\nlower = 8\nupper = 50\n"
    "[parameter.k_p]\nlower = 1e-4\nupper = 0.1\n[parameter.A_d]\nlower = 0.05\nupper = 5\n"
    "[parameter.n_p]\nlower = 0.1\nupper = 10\n[parameter.n_d]\nlower = 0.1\nupper = 10\n";

/// Writes both files; `edit` may change the text of the CSV.
Files write(const Sheet& sheet, const std::function<void(std::string&)>& edit = {},
            const std::string& more = "", const std::string& columns_used = columns) {
  const auto folder = std::filesystem::path(SIMSAND_BINARY_DIR) / "test_results" / "poor_data";
  std::filesystem::create_directories(folder);
  const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  Files files{(folder / (name + ".csv")).string(), (folder / (name + ".toml")).string()};
  std::string text = "# a comment\nstrain,q,volume\n";
  for (const auto& r : sheet.rows)
    text += fmt::format("{:.6g},{:.6g},{:.6g}\n", 100 * r.strain, r.q / 1e3, -100 * r.volume);
  if (edit) edit(text);
  std::ofstream(files.csv) << text;
  std::ofstream(files.toml) << fmt::format(
      "[material]\nfile = \"{}/data/materials/SS.toml\"\n{}{}{}[error.deviatoric_stress]\nabsolute = "
      "50.0\nrelative = 0.02\n"
      "[error.volumetric_strain]\nabsolute = 5e-4\nrelative = 0.02\n[search]\nstarts = 3\ncandidates = "
      "16\niterations = 40\n",
      SIMSAND_SOURCE_DIR, all_parameters, columns_used, test_table(files.csv, more));
  return files;
}

/// The one line with which a fit is refused; empty if it is not.
std::string refusal(const Files& files) {
  try {
    read_fit(files.toml);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const Files& files, const std::vector<std::string>& parts) {
  const auto line = refusal(files);
  EXPECT_FALSE(line.empty()) << "accepted";
  EXPECT_EQ(line.find('\n'), line.npos) << line;
  for (const auto& part : parts) EXPECT_NE(line.find(part), line.npos) << "'" << part << "' in: " << line;
}

struct Fitted {
  Fit fit;
  std::unique_ptr<Objective> objective;
  BestFit best;
  Identifiability known;
  std::vector<std::string> warned;
  bool warns(const std::string& part) const {
    return std::any_of(warned.begin(), warned.end(), [&](const auto& w) { return w.find(part) != w.npos; });
  }
};

std::unique_ptr<Fitted> fitted(const Files& files) {
  auto out = std::make_unique<Fitted>();
  out->fit = read_fit(files.toml);
  out->objective = std::make_unique<Objective>(out->fit);
  out->best = least_squares(*out->objective);
  out->known = identify(*out->objective, out->best);
  out->warned = warnings({*out->objective, out->best, out->known, nullptr, "", 0});
  return out;
}

TEST(PoorData, TheGoodSheetIsAccepted) {
  EXPECT_EQ(refusal(write(good_sheet(40))), "");
}

TEST(PoorData, ThreePointsAreNoFit) {
  const auto f = fitted(write(good_sheet(3)));
  EXPECT_TRUE(f->warns("NOT determined") || f->warns("do not determine"))
      << report_text({*f->objective, f->best, f->known, nullptr, "", 0});
  EXPECT_TRUE(f->warns("no more independent values") || f->warns("do not determine"));
}

TEST(PoorData, OneTestLeavesParametersOpen) {
  const auto f = fitted(write(good_sheet(40)));
  // Every parameter that is far from the truth has been flagged.
  const auto truth = f->fit.material.material.properties;
  for (int d = 0; d < f->fit.parameters(); ++d) {
    const auto& p = f->fit.unknowns[d];
    const double off =
        std::abs(f->best.best.end[d] - p.coordinate(truth[p.property])) / (p.highest() - p.lowest());
    if (f->known.findings[d] == Finding::determined) {
      EXPECT_LT(off, 3 * weak_deviation) << p.name;
    }
  }
  EXPECT_FALSE(f->warned.empty());
}

TEST(PoorData, ConstantCurve) {
  auto sheet = good_sheet(40);
  for (auto& row : sheet.rows) row.q = 9e3;
  expect_refused(write(sheet), {"ConstantCurve", "deviatoric_stress is constant", "dead sensor"});
}

TEST(PoorData, NotANumberIsNamedByLine) {
  for (const char* bad : {"nan", "inf", "", "1,2", "1.5abc"}) {
    const auto files = write(good_sheet(10), [&](std::string& text) {
      const auto row =
          text.find("\n", text.find("\n", text.find("strain,q")) + 1) + 1; // the second of numbers, line 4
      const auto comma = text.find(',', row);
      text.replace(comma + 1, text.find(',', comma + 1) - comma - 1, bad);
    });
    expect_refused(files, {files.csv + ":4:"});
  }
}

TEST(PoorData, SwappedColumns) {
  auto sheet = good_sheet(40);
  for (auto& row : sheet.rows) { // strain and volumetric strain
    const double strain = row.strain;
    row.strain = -row.volume;
    row.volume = -strain;
  }
  expect_refused(write(sheet), {"turns back"});
  sheet = good_sheet(40);
  for (auto& row : sheet.rows) { // q in kPa and volume in per cent
    const double q = row.q;
    row.q = -row.volume * 1e5;
    row.volume = -q / 1e5;
  }
  EXPECT_NE(refusal(write(sheet)), "");
  sheet = good_sheet(40);
  for (auto& row : sheet.rows) { // strain in per cent and q in kPa
    const double q = row.q;
    row.q = row.strain * 1e5;
    row.strain = q / 1e5;
  }
  EXPECT_NE(refusal(write(sheet)), "");
}

TEST(PoorData, StressInTheWrongUnit) {
  for (const double factor : {1e-3, 1e3}) {
    auto sheet = good_sheet(40);
    for (auto& row : sheet.rows) row.q *= factor;
    expect_refused(write(sheet), {"stress ratio", "units of stress"});
  }
}

TEST(PoorData, WrongSignOrUnitOfVolume) {
  auto sheet = good_sheet(40);
  for (auto& row : sheet.rows) row.volume *= 100; // per cent read as a fraction
  EXPECT_NE(refusal(write(sheet)), "");
  sheet = good_sheet(
      40); // dilation counted as contraction: no curve of the model bends so, and the report says so
  for (auto& row : sheet.rows) row.volume = -row.volume;
  const auto f = fitted(write(sheet));
  EXPECT_TRUE(f->warns("times the errors stated")) << f->warned.size();
}

TEST(PoorData, ImpossibleVoidRatio) {
  for (const char* e :
       {"void_ratio = 58", "void_ratio = -0.58", "void_ratio = 0.01", "void_ratio = 0", "void_ratio = nan"})
    expect_refused(write(good_sheet(10), {}, e), {"void_ratio"});
  const std::string with_e =
      std::string(columns) + "[columns.void_ratio]\ncolumn = \"volume\"\nunit = \"%\"\n";
  expect_refused(write(good_sheet(10), {}, "", with_e), {"void ratio"});
}

TEST(PoorData, ColumnsAndUnitsAreDeclared) {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const auto sheet = good_sheet(10);
  expect_refused(write(sheet, {}, "", replaced(columns, "\"q\"", "\"Q\"")), {"column", "strain, q, volume"});
  expect_refused(write(sheet, {}, "", replaced(columns, "kPa", "psi")), {"unit", "psi"});
  expect_refused(write(sheet, {}, "", replaced(columns, "positive = \"dilation\"\n", "")), {"positive"});
  expect_refused(write(sheet, {}, "", replaced(columns, "unit = \"kPa\"", "unit = \"kPa\"\nunits = 1")),
                 {"units"});
}

TEST(PoorData, FitFileIsStrict) {
  const auto files = write(good_sheet(10));
  std::ifstream in(files.toml);
  const std::string good(std::istreambuf_iterator<char>(in), {});
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    std::ofstream(files.toml) << text;
    return refusal(files);
  };
  EXPECT_NE(with("[parameter.phi]", "[parameter.psi]").find("parameter.psi"), std::string::npos);
  EXPECT_NE(with("lower = 8", "lower = 80").find("parameter.phi.lower"), std::string::npos);
  EXPECT_NE(with("lower = 8", "lower = 50").find("upper"), std::string::npos);
  EXPECT_NE(with("lower = 8", "lower = 8\nlower = 9").find(files.toml), std::string::npos);
  EXPECT_NE(with("lower = 8", "").find("lower"), std::string::npos);
  EXPECT_NE(with("starts = 3", "starts = 0").find("search.starts"), std::string::npos);
  EXPECT_NE(
      with("[error.deviatoric_stress]\nabsolute = 50.0\nrelative = 0.02\n", "").find("deviatoric_stress"),
      std::string::npos);
}

} // namespace

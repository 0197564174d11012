// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/command.hpp"
#include "drivers/element/element.hpp"
#include "drivers/element/failed_call.hpp"
#include "drivers/element/pictures.hpp"
#include "drivers/files/csv_write.hpp"
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <omp.h>
#include <set>
#include <stdexcept>
#include <variant>

namespace drivers {
namespace {

namespace fs = std::filesystem;

/// A text file, or standard output, whose errors are exceptions that name it.
class OutputFile {
public:
  /// "" or "-": standard output.
  explicit OutputFile(const std::string& name)
      : name(name), to_standard(name.empty() || name == "-"),
        file(to_standard ? stdout : std::fopen(name.c_str(), "w"),
             to_standard ? [](std::FILE* f) { return std::fflush(f); } : std::fclose) {
    if (!file) fail();
  }
  void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size()) fail();
  }

private:
  [[noreturn]] void fail() const {
    throw std::runtime_error(fmt::format("{}: cannot be written", to_standard ? "standard output" : name));
  }
  std::string name;
  bool to_standard;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file;
};

constexpr int digits = 12; // of a number in a table

std::string header(const std::vector<OutputColumn>& columns) {
  std::string line = "stage,step";
  for (const auto& c : columns) line += ',' + c.header();
  return line;
}

void add_row(CsvWriter& table, const ElementRow& row, const std::vector<OutputColumn>& columns) {
  table.cell(row.stage);
  table.cell(row.step);
  for (const auto& c : columns) table.cell(Rounded{c.value(row), digits});
  table.end_row();
}

std::string envelope_header() {
  std::string line = "stage,direction_deg";
  for (const char* what : {"strain_increment_{}", "stress_{}_Pa", "stress_change_{}_Pa"})
    for (const char* c : {"11", "22", "33", "12", "23", "31"})
      line += ',' + fmt::format(fmt::runtime(what), c);
  return line;
}

void add_row(CsvWriter& table, const EnvelopeRow& row) {
  table.cell(row.stage);
  table.cell(Rounded{row.angle, digits});
  for (const auto* six : {&row.strain_increment, &row.stress, &row.stress_change})
    for (const double v : *six) table.cell(Rounded{v, digits});
  table.end_row();
}

bool has_envelope(const ElementCase& element) {
  return std::any_of(element.stages.begin(), element.stages.end(), [](const auto& s) { return s.envelope; });
}

bool to_standard(const std::string& output) {
  return output.empty() || output == "-";
}

std::string envelope_file(const ElementOptions& options) {
  if (!options.envelope.empty()) return options.envelope;
  if (to_standard(options.output))
    throw std::runtime_error(
        fmt::format("{}: an envelope stage needs a file: give -o or --envelope", options.path_file));
  const fs::path path = options.output;
  return path.parent_path() / (path.stem().string() + "_envelope.csv");
}

std::string failed_point_file(const ElementOptions& options) {
  if (!options.failed_point.empty()) return options.failed_point;
  const fs::path folder = to_standard(options.output) ? "" : fs::path(options.output).parent_path();
  return (folder / "failed_point.toml").string();
}

void run_case(const ElementCase& element, const ElementOptions& options) {
  if (!options.resolved.empty()) OutputFile(options.resolved).write(element.resolved);
  const auto columns = output_columns(element.material, element.critical);
  CsvWriter table(header(columns)), probes(envelope_header());
  std::unique_ptr<OutputFile> probe_file;
  if (has_envelope(element)) probe_file = std::make_unique<OutputFile>(envelope_file(options));
  if (probe_file) probe_file->write(probes.take());
  OutputFile file(options.output);
  file.write(table.take());
  const auto write_row = [&](const ElementRow& row) {
    add_row(table, row, columns);
    file.write(table.take());
  };
  const auto write_probe = [&](const EnvelopeRow& row) {
    add_row(probes, row);
    probe_file->write(probes.take());
  };
  run_element_case(element, write_row, write_probe, failed_point_file(options));
}

void run_case(FailedCall failed, const ElementOptions& options) {
  std::string fault;
  const auto table = repeat_call(failed, fault);
  OutputFile(options.output).write(table);
  if (!fault.empty())
    throw std::runtime_error(fmt::format("{}: material {} {}: at time {:.9g} s", options.path_file,
                                         failed.material.material.name, fault,
                                         failed.call.increment.total_time));
}

int print_error(const std::exception& error) {
  fmt::print(stderr, "simsand element: {}\n", error.what());
  return 1;
}

/// Input and output files of each path of a batch.
std::vector<ElementOptions> jobs_of(const ElementBatch& batch) {
  const bool several = batch.path_files.size() > 1, folder = several || fs::is_directory(batch.output);
  if (!folder)
    return {{batch.path_files.front(), batch.output, batch.resolved, batch.envelope, batch.settings, {}}};
  if (to_standard(batch.output)) throw std::runtime_error("several paths need a folder: give -o FOLDER");
  if (several && (!batch.resolved.empty() || !batch.envelope.empty()))
    throw std::runtime_error("--resolved and --envelope are for a single path");
  std::error_code error;
  fs::create_directories(batch.output, error);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot be created: {}", batch.output, error.message()));
  std::vector<ElementOptions> jobs;
  std::set<std::string> names;
  for (const auto& file : batch.path_files) {
    const auto name = fs::path(file).stem().string();
    if (!names.insert(name).second)
      throw std::runtime_error(fmt::format("{}: a second path named '{}'", file, name));
    const auto output = (fs::path(batch.output) / name).string();
    jobs.push_back({file, output + ".csv", batch.resolved, batch.envelope, batch.settings,
                    output + "_failed_point.toml"});
  }
  return jobs;
}

/// A loading path, or a call that failed in a run and is to be repeated.
using Case = std::variant<ElementCase, FailedCall>;
using Cases = std::vector<std::optional<Case>>;

Case read_case(const ElementOptions& job) {
  const auto document = read_toml(job.path_file, job.settings);
  if (document.has("call")) return read_failed_call(document);
  return read_element_case(document);
}

const LoadedMaterial& material_of(const Case& one) {
  return std::visit([](const auto& c) -> const LoadedMaterial& { return c.material; }, one);
}

Cases read_cases(const std::vector<ElementOptions>& jobs, int& failed) {
  Cases cases(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) try {
      cases[i] = read_case(jobs[i]);
    } catch (const std::exception& error) {
      failed = print_error(error);
    }
  return cases;
}

int run_cases(const Cases& cases, const std::vector<ElementOptions>& jobs, int wanted) {
  std::atomic<int> failed = 0;
  const bool all_simsand =
      std::all_of(cases.begin(), cases.end(), [](const auto& c) { return !c || material_of(*c).is_simsand; });
  const int threads = wanted > 0 ? wanted : all_simsand ? omp_get_max_threads() : 1;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (cases[i]) try {
        std::visit([&](const auto& c) { run_case(c, jobs[i]); }, *cases[i]);
      } catch (const std::exception& error) {
#pragma omp critical
        failed = print_error(error);
      }
  return failed;
}

} // namespace

int run_element(const ElementOptions& options) {
  int failed = 0;
  const auto cases = read_cases({options}, failed);
  return failed ? failed : run_cases(cases, {options}, 1);
}

int run_elements(const ElementBatch& batch) {
  try {
    if (!batch.figures.empty() && to_standard(batch.output))
      throw std::runtime_error("--figures needs tables in files: give -o");
    const auto jobs = jobs_of(batch);
    int failed = 0;
    const auto cases = read_cases(jobs, failed);
    failed = std::max(failed, run_cases(cases, jobs, batch.threads));
    std::vector<Picture> pictures;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      if (const auto* path = cases[i] ? std::get_if<ElementCase>(&*cases[i]) : nullptr)
        pictures.push_back({jobs[i].output, path->critical});
    if (!batch.figures.empty()) draw_pictures(pictures, batch.figures);
    return failed;
  } catch (const std::exception& error) {
    return print_error(error);
  }
}

} // namespace drivers

// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/utilities.hpp"
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <unistd.h>

namespace host {
namespace {

thread_local const RunningCall* running_call = nullptr;

/// Called when the process ends: reports an end inside of a call.
void report_stop() {
  if (!running_call) return;
  std::fflush(nullptr);
  fmt::print(
      stderr,
      "simsand: material {}: its subroutine ended the program (STOP or exit) at time {:.9g} s; what was "
      "written to the result file until then is readable\n",
      running_call->material, running_call->total_time);
  _exit(1);
}

std::string trimmed(const char* text, std::size_t length) {
  while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\0')) --length;
  return {text, length};
}

/// Prints each message at most ten times, since a subroutine may send it in every call.
void show_message(const char* kind, const std::string& original, const std::string& text) {
  constexpr int most = 10;
  static std::mutex mutex;
  static std::map<std::string, int> shown;
  const std::scoped_lock lock(mutex);
  const int times = ++shown[original];
  if (times > most) return;
  fmt::print(stderr, "{} of material {}: {}{}\n", kind, running_call ? running_call->material : "", text,
             times == most ? " (not shown again)" : "");
}

/// Writes `text` to a Fortran string of `length` characters, filled up with blanks; `used` becomes its length.
void write_fortran(const std::string& text, char* out, int* used, std::size_t length) {
  std::memset(out, ' ', length);
  const std::size_t n = std::min(length, text.size());
  std::memcpy(out, text.data(), n);
  if (used) *used = int(n);
}

/// That of the running call; outside of a call, as in a library that is being loaded, a nameless one.
const Job& current_job() {
  static const Job none;
  return running_call ? running_call->job : none;
}

} // namespace

RunningCall::RunningCall(const std::string& material, const Job& job, double total_time)
    : material(material), job(job), total_time(total_time) {
  static const int registered = std::atexit(report_stop);
  static_cast<void>(registered);
  running_call = this;
}

RunningCall::~RunningCall() {
  running_call = nullptr;
}

std::string substituted(const std::string& text, const int* integers, const double* reals, const char* texts,
                        std::size_t text_length) {
  std::string out;
  for (std::size_t c = 0; c < text.size(); ++c) {
    const char kind = text[c] == '%' && c + 1 < text.size() ? char(std::toupper(text[c + 1])) : ' ';
    if (kind == 'I' && integers)
      out += fmt::format("{}", *integers++);
    else if (kind == 'R' && reals)
      out += fmt::format("{:g}", *reals++);
    else if (kind == 'S' && texts) {
      out += trimmed(texts, text_length);
      texts += text_length;
    } else {
      out += text[c];
      continue;
    }
    ++c;
  }
  return out;
}

} // namespace host

#pragma GCC visibility push(default)
extern "C" {

void xplb_exit_() {
  const std::string what = "its subroutine asked for the end of the analysis (xplb_exit)";
  if (host::running_call) throw host::VumatExit(what);
  fmt::print(stderr, "simsand: {} outside of a call\n", what);
  std::exit(1);
}

/// lop: 1 information, -1 warning, -2 error, -3 error that ends the analysis.
void xplb_abqerr_(const int* lop, const char* string, const int* integers, const double* reals,
                  const char* texts, std::size_t string_length, std::size_t text_length) {
  const auto original = host::trimmed(string, std::min<std::size_t>(string_length, 500));
  const auto text = host::substituted(original, integers, reals, texts, text_length);
  if (*lop == -3 && host::running_call)
    throw host::VumatExit(fmt::format("its subroutine ended the analysis with \"{}\"", text));
  host::show_message(*lop == 1 ? "message" : *lop == -1 ? "warning" : "error", original, text);
  if (*lop == -3) std::exit(1);
}

void vgetjobname_(char* name, int* length, std::size_t size) {
  host::write_fortran(host::current_job().name, name, length, size);
}

void vgetoutdir_(char* folder, int* length, std::size_t size) {
  const auto& own = host::current_job().folder;
  host::write_fortran(std::filesystem::absolute(own.empty() ? "." : own).lexically_normal().string(), folder,
                      length, size);
}

/// One process, whatever its threads.
void vgetrank_(int* rank) {
  *rank = 0;
}

void vgetnumcpus_(int* count) {
  *count = 1;
}

} // extern "C"
#pragma GCC visibility pop

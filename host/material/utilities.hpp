// SPDX-License-Identifier: BSD-3-Clause
// The routines of ABAQUS that a VUMAT may call, exported by every program that links the host: xplb_exit,
// xplb_abqerr, vgetjobname, vgetoutdir, vgetrank, vgetnumcpus. A library that is loaded with dlopen finds them
// if the program was linked with its symbols exported (ENABLE_EXPORTS).
#pragma once
#include <stdexcept>
#include <string>

namespace host {

/// What subroutines are told of the run; `folder` is also where evidence of a failure is written (none if empty).
struct Job {
  std::string name = "simsand", folder;
};
/// The one of this process. To be set before the first call.
Job& job();

/// Thrown through a subroutine that asked for the end of the analysis: it must not get control back. GCC and
/// gfortran write the tables this needs by default on x86-64 (not with -fno-asynchronous-unwind-tables).
struct VumatExit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Marks, while it lives, that this thread is inside a subroutine. Should the process then end by itself (STOP
/// in Fortran, exit in C), that becomes an error with a non-zero status.
class RunningCall {
public:
  RunningCall(const std::string& material, double total_time);
  ~RunningCall();
  RunningCall(const RunningCall&) = delete;
  RunningCall& operator=(const RunningCall&) = delete;

  const std::string& material;
  const double total_time; ///< s
};

/// `text` with its 1st, 2nd, ... %I, %R and %S replaced by integers, reals and texts of `text_length` characters.
/// A placeholder without its array stays.
std::string substituted(const std::string& text, const int* integers, const double* reals, const char* texts,
                        std::size_t text_length);

} // namespace host

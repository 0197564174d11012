// SPDX-License-Identifier: BSD-3-Clause
// The routines of ABAQUS that a VUMAT may call, exported by every program that links the host: xplb_exit,
// xplb_abqerr, vgetjobname, vgetoutdir, vgetrank, vgetnumcpus. A library that is loaded with dlopen finds them
// if the program was linked with its symbols exported (ENABLE_EXPORTS).
#pragma once
#include "host/material/job.hpp"
#include <stdexcept>
#include <string>

namespace host {

/// Thrown through a subroutine that asked for the end of the analysis, since it must not get control back. GCC and
/// gfortran write the unwind tables that this needs by default on x86-64 (not with -fno-asynchronous-unwind-tables).
struct VumatExit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Marks, while it lives, that this thread is inside a subroutine, and what the routines below answer it. If the process
/// ends meanwhile (STOP in Fortran, exit in C), it ends with an error message and a non-zero status.
class RunningCall {
public:
  RunningCall(const std::string& material, const Job& job, double total_time);
  ~RunningCall();
  RunningCall(const RunningCall&) = delete;
  RunningCall& operator=(const RunningCall&) = delete;

  const std::string& material;
  const Job& job;
  const double total_time; ///< s
};

/// `text` with its 1st, 2nd, ... %I, %R and %S replaced by integers, reals and texts of `text_length` characters.
/// A placeholder without its array stays.
std::string substituted(const std::string& text, const int* integers, const double* reals, const char* texts,
                        std::size_t text_length);

} // namespace host

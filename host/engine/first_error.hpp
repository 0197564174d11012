// SPDX-License-Identifier: BSD-3-Clause
// Errors in parallel loops. An exception must not leave a loop of threads, and the one that is reported must not depend
// on the number of threads.
#pragma once
#include <exception>
#include <limits>
#include <mutex>

namespace host {

/// Keeps the exception of the lowest index.
class FirstError {
public:
  template <class F> void guarded(int index, F&& f) {
    try {
      f();
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (index >= lowest) return;
      lowest = index;
      error = std::current_exception();
    }
  }
  /// Throws the exception that was kept, if there is one.
  void rethrow() const {
    if (error) std::rethrow_exception(error);
  }

private:
  std::mutex mutex;
  std::exception_ptr error;
  int lowest = std::numeric_limits<int>::max();
};

} // namespace host

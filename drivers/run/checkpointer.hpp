// SPDX-License-Identifier: BSD-3-Clause
// When a run writes its checkpoints.
#pragma once
#include "drivers/run/recorder.hpp"
#include "drivers/run/resume.hpp"
#include <algorithm>
#include <chrono>

namespace drivers {

template <class Geometry> class Checkpointer {
public:
  explicit Checkpointer(const host::Scene& scene)
      : folder(scene.output_folder), header(header_of(scene)), interval(scene.checkpoint_interval) {}

  /// True after the scene's interval, and not so often that writing takes more than a twentieth of the time.
  bool due() const { return seconds_since(last) > std::max(interval, 20 * cost); }

  /// Replaces the checkpoint by the present state; `spent` is what the run has taken so far.
  void write(host::Simulation<Geometry>& s, Recorder<Geometry>& recorder, const host::Spent& spent) {
    const auto start = Clock::now();
    header.time = s.time;
    header.steps = double(s.steps);
    header.particles = s.particles.count;
    auto progress = recorder.progress();
    progress.spent = spent;
    host::write_checkpoint(checkpoint_path(folder), previous_checkpoint_path(folder), header, s, progress);
    last = Clock::now();
    cost = seconds_since(start);
  }

private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  std::filesystem::path folder;
  host::CheckpointHeader header;
  double interval, cost = 0; ///< s
  Clock::time_point last = Clock::now();
};

} // namespace drivers

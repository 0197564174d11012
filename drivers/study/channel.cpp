// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/channel.hpp"
#include <filesystem>
#include <fmt/format.h>

namespace drivers {

void study_channel(const ChannelStudyOptions& options) {
  namespace fs = std::filesystem;
  const auto& study = options.study;
  const auto materials = fs::absolute(fs::path(study.data) / "materials");
  const auto scene = (fs::path(study.data) / "scenes/channel.toml").string();
  std::vector<StudyRun> runs;
  const auto add = [&](const std::string& name, std::vector<std::string> settings) {
    settings.push_back(fmt::format("scene.spacing={}", options.spacing));
    runs.push_back({name, scene, (fs::path(study.folder) / name).string(), std::move(settings)});
  };
  for (double void_ratio : {0.75, 0.85, 0.95, 1.05})
    add(fmt::format("simsand_e{:.2f}", void_ratio), {fmt::format("material.void_ratio={}", void_ratio)});
  for (const auto* dilation : {"0", "5"})
    add(fmt::format("drucker_prager_psi{}", dilation),
        {"material.file=" + (materials / fmt::format("rods_drucker_prager_psi{}.toml", dilation)).string(),
         "material.kinematics=jaumann"}); // isotropic: no need of F and U
  run_and_report(std::move(runs), "study_channel.py", study);
}

} // namespace drivers

// SPDX-License-Identifier: BSD-3-Clause
// Where the files are that the program comes with: data, scripts, the material as source, and material libraries.
#pragma once
#include <string>

namespace drivers {

/// The folder of data and scripts: $SIMSAND_SHARE if it is set; share/simsand beside the program, where the build puts
/// it; or that of an installed program. Throws std::runtime_error naming these places if none of them is a folder.
std::string share_folder();

/// The path of a file below the share folder, as "figures/element_figures.py". Throws std::runtime_error
/// "PATH: no such file" if it is missing.
std::string resource(const std::string& name);

/// The same, empty if it is missing.
std::string find_resource(const std::string& name);

/// The folder with materials, scenes, paths and reference results.
std::string data_folder();

/// A material library of this project by its bare name: beside the program, or in the installed library folder; else
/// the name as it is, which the loader looks for by its own rules (the program's RUNPATH, LD_LIBRARY_PATH).
std::string material_library(const std::string& name);

} // namespace drivers

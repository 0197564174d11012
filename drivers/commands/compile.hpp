// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <CLI/App.hpp>

namespace commands {

void add_compile(CLI::App& app);

} // namespace commands

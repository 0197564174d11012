// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of PROPS and STATEV, for the head of the single source file.
#include "vumat/parameters.hpp"
#include <cstdio>

int main() {
  std::printf("%s\n%s", simsand::parameter_table().c_str(), simsand::state_table().c_str());
}

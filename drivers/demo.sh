#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 to pictures of a collapse: installs, builds, runs the default scene, draws.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash drivers/install.sh
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build build --target simsand
build/simsand run data/scenes/default.toml
echo
echo "pictures:"
/usr/bin/python3 drivers/figures/figures.py results/default/result.h5

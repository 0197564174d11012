#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs, builds and runs every test. With CI=true warnings are errors.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

werror=OFF
if [ "${CI:-false}" = true ]; then werror=ON; fi

bash drivers/install.sh
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DSIMSAND_WERROR=$werror >/dev/null
cmake --build build
# Two cases side by side, each on one thread; those about threads set their own number.
OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive ctest --test-dir build --output-on-failure -j 2

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs from Debian what building, testing and drawing need; silent when all of it is there.
set -euo pipefail

packages=(
  build-essential gfortran cmake ninja-build pkg-config clang-format
  libeigen3-dev libgsl-dev libhdf5-dev libgtest-dev
  libtomlplusplus-dev libcli11-dev libfmt-dev libspdlog-dev
  python3-matplotlib python3-h5py python3-openpyxl
)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install.sh: needs root, or sudo, to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
install() {
  "${as_root[@]}" apt-get update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}
if ! install >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "install.sh: apt-get failed" >&2
  exit 1
fi

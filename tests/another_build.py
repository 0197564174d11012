#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a result look as if another build had written it: another_build.py RESULT.h5

Alters the attribute `build` in place and renews the checksum at the end of the file (host/files/seal.hpp).
"""
import sys

import h5py

path = sys.argv[1]
with h5py.File(path, "r") as result:
    build = result.attrs["build"]
    build = build if isinstance(build, bytes) else build.encode()
with open(path, "rb") as file:
    content = file.read()[:-16].replace(build, b"x" * len(build))
total = 14695981039346656037
for byte in content:
    total = (total ^ byte) * 1099511628211 % 2**64
with open(path, "wb") as file:
    file.write(content + b"SIMSANDS" + total.to_bytes(8, sys.byteorder))

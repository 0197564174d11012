// SPDX-License-Identifier: BSD-3-Clause
// A library that is none: exports the name without the underscore.
extern "C" __attribute__((visibility("default"))) void vumat() {}

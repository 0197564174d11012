// SPDX-License-Identifier: BSD-3-Clause
// Calls a routine of ABAQUS that no host here has.
extern "C" void vgetvrm_();
extern "C" __attribute__((visibility("default"))) void vumat_() {
  vgetvrm_();
}

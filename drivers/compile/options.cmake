# SPDX-License-Identifier: BSD-3-Clause
# How a user's subroutine is compiled: by `simsand compile`, and for the tests. As ABAQUS compiles it with Intel's
# compiler, as far as GCC can.
#
# -frecursive: local arrays on the stack of their thread. Without it those above 64 KiB are static, and two threads
# overwrite each other's numbers. -fdec, -std=legacy: Cray pointers, DEC and older Fortran. Lines of up to 132 characters.
set(VUMAT_FORTRAN_OPTIONS -fPIC -frecursive -fdec -std=legacy -ffixed-line-length-132 -ffree-line-length-none)
set(VUMAT_C_OPTIONS -fPIC)
set(VUMAT_CXX_OPTIONS -fPIC -std=gnu++17)
set(VUMAT_RELEASE_OPTIONS -O2)
# Indices are checked, and variables without a value hold a number that traps.
set(VUMAT_DEBUG_OPTIONS -O0 -g)
set(VUMAT_FORTRAN_DEBUG_OPTIONS -fcheck=bounds,do,mem,pointer -fbacktrace -finit-real=snan -finit-integer=-987654321)
set(VUMAT_CXX_DEBUG_OPTIONS -D_GLIBCXX_ASSERTIONS)

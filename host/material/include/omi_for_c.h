/* SPDX-License-Identifier: BSD-3-Clause
   Names of Fortran for subroutines in C and C++: FOR_NAME(vumat, VUMAT) and FOR_NAME(vumat). */
#ifndef SIMSAND_OMI_FOR_C_H
#define SIMSAND_OMI_FOR_C_H
#define FOR_NAME(lower, ...) lower##_
#endif

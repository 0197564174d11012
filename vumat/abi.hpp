// SPDX-License-Identifier: BSD-3-Clause
// The ABAQUS/Explicit VUMAT calling convention as C++ sees it: 33 arguments by reference and the
// hidden length of `cmname` by value. Hosts and drivers include this file and nothing else of vumat/.
//
// Arrays are Fortran column-major and the block index k runs fastest: component c of point k of an
// array `a(nblock, *)` is a[c * nblock + k].
//
// Sign: tension positive. Shear strain: tensor (half the engineering shear).
//
//  no. name              shape                    in/out  meaning, unit
//   1  nblock            1                        in      points in this block
//   2  ndir              1                        in      direct components, always 3 here
//   3  nshr              1                        in      shear components: 1 (plane strain, axisymmetric) or 3
//   4  nstatev           1                        in      state variables per point
//   5  nfieldv           1                        in      field variables per point
//   6  nprops            1                        in      material constants
//   7  lanneal           1, or array since 2023   in      first entry 1: annealing call
//   8  stepTime          1                        in      s, at the end of the increment
//   9  totalTime         1                        in      s; 8 and 9 both 0: data check, answer elastically
//  10  dt                1, or array since 2023   in      s
//  11  cmname            character*80             in      material name, upper case, blank padded
//  12  coordMp           nblock, *                in      m
//  13  charLength        nblock                   in      m, particle spacing in an SPH host
//  14  props             nprops                   in      material constants
//  15  density           nblock                   in      kg/m3, current
//  16  strainInc         nblock, ndir+nshr        in      corotational strain increment
//  17  relSpinInc        nblock, nshr             in      spin increment relative to the corotational frame
//  18  tempOld           nblock                   in
//  19  stretchOld        nblock, ndir+nshr        in      right stretch U at the start
//  20  defgradOld        nblock, ndir+2*nshr      in      deformation gradient F at the start
//  21  fieldOld          nblock, nfieldv          in
//  22  stressOld         nblock, ndir+nshr        in      Pa, Cauchy (effective), corotational
//  23  stateOld          nblock, nstatev          in
//  24  enerInternOld     nblock                   in      J/kg
//  25  enerInelasOld     nblock                   in      J/kg
//  26  tempNew           nblock                   in
//  27  stretchNew        nblock, ndir+nshr        in      U at the end
//  28  defgradNew        nblock, ndir+2*nshr      in      F at the end
//  29  fieldNew          nblock, nfieldv          in
//  30  stressNew         nblock, ndir+nshr        out
//  31  stateNew          nblock, nstatev          out
//  32  enerInternNew     nblock                   out
//  33  enerInelasNew     nblock                   out
//  34  length of cmname  by value                 in      size_t with gfortran 8 and later
//
// Symmetric components: 11, 22, 33, 12, 23, 31 (nshr = 1: 11, 22, 33, 12).
// Non-symmetric:        11, 22, 33, 12, 23, 31, 21, 32, 13 (nshr = 1: 11, 22, 33, 12, 21).
#pragma once
#include <cstddef>

namespace vumat {

/// Signature of a VUMAT whose reals are `Real` (double with `double=both`, float by default).
template <class Real>
using Subroutine = void(const int* nblock, const int* ndir, const int* nshr, const int* nstatev,
                        const int* nfieldv, const int* nprops, const int* lanneal, const Real* stepTime,
                        const Real* totalTime, const Real* dt, const char* cmname, const Real* coordMp,
                        const Real* charLength, const Real* props, const Real* density, const Real* strainInc,
                        const Real* relSpinInc, const Real* tempOld, const Real* stretchOld,
                        const Real* defgradOld, const Real* fieldOld, const Real* stressOld,
                        const Real* stateOld, const Real* enerInternOld, const Real* enerInelasOld,
                        const Real* tempNew, const Real* stretchNew, const Real* defgradNew,
                        const Real* fieldNew, Real* stressNew, Real* stateNew, Real* enerInternNew,
                        Real* enerInelasNew, std::size_t cmname_length);

/// Length of `cmname`.
inline constexpr std::size_t name_length = 80;

/// Largest block a host may pass: old subroutines hold local arrays of this many points.
inline constexpr int max_block = 128;

/// Positions of the symmetric components.
enum Component { c11, c22, c33, c12, c23, c31 };

} // namespace vumat

// SPDX-License-Identifier: BSD-3-Clause
// Small laws in Fortran for tests that compile them.
#pragma once
#include "tests/verification/vumat_program.hpp"
#include <string>

namespace tests {

/// A VUMAT in fixed form: the interface, then `declarations`, then `body`, of whole lines. Its first argument is `first`.
inline std::string fixed_vumat(const std::string& body, const std::string& declarations = "",
                               const std::string& include = "vaba_param.inc",
                               const std::string& first = "nblock") {
  return "      subroutine vumat(" + first +
         ", ndir, nshr, nstatev, nfieldv, nprops,\n"
         "     1  lanneal, stepTime, totalTime, dt, cmname, coordMp, charLength,\n"
         "     2  props, density, strainInc, relSpinInc, tempOld, stretchOld,\n"
         "     3  defgradOld, fieldOld, stressOld, stateOld, enerInternOld,\n"
         "     4  enerInelasOld, tempNew, stretchNew, defgradNew, fieldNew,\n"
         "     5  stressNew, stateNew, enerInternNew, enerInelasNew)\n"
         "      include '" +
         include + "'\n" +
         (first == "nblock" ? "      dimension props(nprops), density(nblock), coordMp(nblock,*),\n"
                              "     1  charLength(nblock), strainInc(nblock,ndir+nshr),\n"
                              "     2  relSpinInc(nblock,nshr), tempOld(nblock), tempNew(nblock),\n"
                              "     3  fieldOld(nblock,nfieldv), fieldNew(nblock,nfieldv),\n"
                              "     4  stressOld(nblock,ndir+nshr), stressNew(nblock,ndir+nshr),\n"
                              "     5  stateOld(nblock,nstatev), stateNew(nblock,nstatev),\n"
                              "     6  enerInternOld(nblock), enerInternNew(nblock),\n"
                              "     7  enerInelasOld(nblock), enerInelasNew(nblock)\n"
                            : "") +
         "      character*80 cmname\n" + declarations + body + "      end\n";
}

/// Elasticity by Young's modulus and Poisson's ratio in PROPS(1), PROPS(2); `k` runs over the block.
inline const std::string elastic_body =
    "      twog = props(1)/(1 + props(2))\n"
    "      alam = twog*props(2)/(1 - 2*props(2))\n"
    "      do k = 1, nblock\n"
    "        tr = strainInc(k,1) + strainInc(k,2) + strainInc(k,3)\n"
    "        do i = 1, ndir + nshr\n"
    "          stressNew(k,i) = stressOld(k,i) + twog*strainInc(k,i)\n"
    "          if (i .le. ndir) stressNew(k,i) = stressNew(k,i) + alam*tr\n"
    "        end do\n"
    "      end do\n";

inline void write(const std::string& name, const std::string& text) {
  std::ofstream(folder() / name) << text;
}

/// `simsand compile` of files in the test's folder.
inline Outcome compile(const std::string& arguments) {
  return simsand("compile " + arguments);
}

/// A `[material]` table of a library in the test's folder.
inline std::string own_material(const std::string& library, const std::string& properties, int states,
                                const std::string& extra = "") {
  return fmt::format("[material]\nlibrary = \"{}/{}\"\nname = \"law\"\nproperties = {}\n"
                     "state_variables = {}\ndensity = 1500.0\n{}\n",
                     folder().string(), library, properties, states, extra);
}

} // namespace tests

// SPDX-License-Identifier: BSD-3-Clause
// `simsand compile` on sources as users have them, and what it makes, in the element driver and in the SPH host.
#include "tests/verification/fortran_source.hpp"

namespace {

using namespace tests;

const std::string shear =
    "[[stage]]\ncontrol = \"simple-shear-undrained\"\nshear_strain = 0.01\nincrements = 2\n";

/// The table of a shear by a library; one failure if there is none.
std::string answer(const std::string& library) {
  const auto outcome = run_path(own_material(library, "[2e6, 0.25]", 0), shear, 1e3);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

std::string compiled_answer(const std::string& arguments) {
  const auto outcome = compile(arguments + " -o law.so");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "law.so\n");
  return answer("law.so");
}

/// The same law in free form, its interface in a few long lines.
const std::string free_vumat =
    "subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, stepTime, totalTime, dt, &\n"
    "  cmname, coordMp, charLength, props, density, strainInc, relSpinInc, tempOld, stretchOld, defgradOld, "
    "&\n"
    "  fieldOld, stressOld, stateOld, enerInternOld, enerInelasOld, tempNew, stretchNew, defgradNew, "
    "fieldNew, &\n"
    "  stressNew, stateNew, enerInternNew, enerInelasNew)\n"
    "include 'Vaba_Param.inc'\n"
    "dimension props(nprops), strainInc(nblock,ndir+nshr), stressOld(nblock,ndir+nshr), "
    "stressNew(nblock,ndir+nshr)\n"
    "character*80 cmname\n" +
    elastic_body + "end subroutine\n";

TEST(Compile, BothFormsIncludeWhatAbaqusProvidesBySeveralNames) {
  write("fixed.f", fixed_vumat(elastic_body));
  const auto expected = compiled_answer("fixed.f");
  for (const auto* name : {"VABA_PARAM.INC", "aba_param.inc", "ABA_PARAM.INC", "vaba_PARAM.inc"}) {
    write("other.for", fixed_vumat(elastic_body, "", name));
    EXPECT_EQ(compiled_answer("other.for"), expected) << name;
  }
  write("free.f90", free_vumat);
  EXPECT_EQ(compiled_answer("free.f90"), expected);
  write("directive.for", "!DEC$ FREEFORM\n" + free_vumat);
  EXPECT_EQ(compiled_answer("directive.for"), expected);
  write("free.for", free_vumat);
  EXPECT_EQ(compiled_answer("free.for --form free"), expected);
  const auto refused = compile("free.for -o refused.so");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("free.for:1: this looks like free form in a file whose suffix says fixed form"),
            std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder() / "refused.so"));
}

TEST(Compile, DialectOfOldCode) {
  write("plain.f", fixed_vumat(elastic_body));
  const auto expected = compiled_answer("plain.f");
  // Beyond column 72; a Cray pointer; the preprocessor; a DEC structure; a file that is included.
  const std::string blanks(60, ' ');
  write("twice.inc", "#define TWICE 2\n");
  write("old.f", fixed_vumat("      ip = loc(props)\n"
                             "      own.young = v(1)\n"
                             "#include \"twice.inc\"\n"
                             "#if TWICE == 2\n"
                             "      twog = " +
                                 blanks +
                                 "own.young/(1 + v(2))\n"
                                 "#else\n      twog = nonsense +\n#endif\n" +
                                 elastic_body,
                             "      pointer (ip, v(*))\n"
                             "      structure /numbers/\n        real*8 young\n      end structure\n"
                             "      record /numbers/ own\n"));
  EXPECT_EQ(compiled_answer("old.f"), expected);
}

TEST(Compile, SeveralFilesAndModules) {
  write("plain.f", fixed_vumat(elastic_body));
  const auto expected = compiled_answer("plain.f");
  write("numbers.f90", "module numbers\n  real*8, parameter :: two = 2\nend module\n");
  auto source = fixed_vumat(elastic_body);
  source.insert(source.find("      include"), "      use numbers\n");
  source.replace(source.find("1 - 2*"), 6, "1 - two*");
  write("law.f", source);
  EXPECT_EQ(compiled_answer("numbers.f90 law.f"), expected);
  const auto wrong = compile("law.f numbers.f90 -o law.so");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.err.find("the source of the module must be named before this file"), std::string::npos)
      << wrong.err;
}

/// Elasticity in C, by its name in ABAQUS.
const std::string in_c =
    "(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int* nfieldv,\n"
    " const int* nprops, const int* lanneal, const double* stepTime, const double* totalTime,\n"
    " const double* dt, const char* cmname, const double* coordMp, const double* charLength,\n"
    " const double* props, const double* density, const double* strainInc, const double* relSpinInc,\n"
    " const double* tempOld, const double* stretchOld, const double* defgradOld, const double* fieldOld,\n"
    " const double* stressOld, const double* stateOld, const double* enerInternOld,\n"
    " const double* enerInelasOld, const double* tempNew, const double* stretchNew,\n"
    " const double* defgradNew, const double* fieldNew, double* stressNew) {\n"
    "  double twog = props[0] / (1 + props[1]), alam = twog * props[1] / (1 - 2 * props[1]);\n"
    "  int n = *nblock, k, i;\n"
    "  for (k = 0; k < n; ++k) {\n"
    "    double tr = strainInc[k] + strainInc[n + k] + strainInc[2 * n + k];\n"
    "    for (i = 0; i < 3 + *nshr; ++i) {\n"
    "      stressNew[i * n + k] = stressOld[i * n + k] + twog * strainInc[i * n + k];\n"
    "      if (i < 3) stressNew[i * n + k] = stressNew[i * n + k] + alam * tr;\n"
    "    }\n  }\n}\n";

TEST(Compile, CAndCxx) {
  write("plain.f", fixed_vumat(elastic_body));
  const auto expected = compiled_answer("plain.f");
  write("law.c", "#include <aba_for_c.h>\nvoid FOR_NAME(vumat)" + in_c);
  EXPECT_EQ(compiled_answer("law.c"), expected);
  write("law.cpp",
        "#include <omi_for_c.h>\n#include <vector>\nextern \"C\" void FOR_NAME(vumat, VUMAT)" + in_c);
  EXPECT_EQ(compiled_answer("law.cpp"), expected);
}

TEST(Compile, NamesWhatIntelsCompilerTakes) {
  write("intel.f", fixed_vumat("      if (0) then\n        x = 1\n      end if\n"
                               "      if (0.d0 < x < 1.d0) x = 2\n"
                               "      if (flag .eq. other) x = 3\n" +
                                   elastic_body,
                               "      logical flag, other\n"));
  const auto outcome = compile("intel.f -o law.so");
  EXPECT_EQ(outcome.status, 1);
  const auto source = content(folder() / "intel.f");
  const auto line_of = [&](const std::string& text) {
    return 1 + std::count(source.begin(), source.begin() + long(source.find(text)), '\n');
  };
  for (const auto& [text, advice] :
       {std::pair{"if (0) then", "a number stands for a condition"},
        {"0.d0 < x", "`a < x < b` compares"},
        {"flag .eq. other", "two truth values are compared; write .eqv. or .neqv."}})
    EXPECT_NE(outcome.err.find(fmt::format("intel.f:{}: {}", line_of(text), advice)), std::string::npos)
        << outcome.err;
  EXPECT_NE(outcome.err.find("simsand: intel.f: gfortran refused it; see above\n"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder() / "law.so"));
}

TEST(Compile, RefusesWhatNoRunCouldUse) {
  write("name.f", "      subroutine umat(x)\n      x = 1\n      end\n");
  auto outcome = compile("name.f -o law.so");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("law.so: exports no vumat_"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder() / "law.so"));
  outcome = compile("nowhere.f");
  EXPECT_NE(outcome.err.find("simsand: nowhere.f: cannot be read"), std::string::npos) << outcome.err;
  write("law.txt", "text");
  outcome = compile("law.txt");
  EXPECT_NE(outcome.err.find("simsand: law.txt: expected a source in Fortran"), std::string::npos);
}

/// Local arrays of 109 kB, which GCC makes static unless it is told that a subroutine is entered by several threads.
TEST(Compile, LargeLocalArraysBelongToTheirThread) {
  auto body = elastic_body;
  for (auto at = body.find("strainInc(k,"); at != body.npos; at = body.find("strainInc(k,", at + 1))
    body.replace(at, 9, "work");
  write("large.f", fixed_vumat("      do k = 1, nblock\n        do i = 1, ndir + nshr\n"
                               "          work(k,i) = strainInc(k,i)\n        end do\n      end do\n" +
                                   body,
                               "      dimension work(136,100)\n"));
  ASSERT_EQ(compile("large.f -o law.so").status, 0);
  const auto law = own_material("law.so", "[2e6, 0.25]", 0);
  ASSERT_EQ(run_scene(law, "plane_strain", 1, 24).status, 0);
  const auto stress = last("stress");
  ASSERT_EQ(run_scene(law, "plane_strain", 3, 24).status, 0);
  EXPECT_EQ(last("stress"), stress);
}

TEST(Compile, DebuggingFindsAWrongIndex) {
  write("index.f",
        fixed_vumat(elastic_body + "      x = stressNew(1,ndir+nshr+i)\n      if (x .gt. 1) stop\n"));
  ASSERT_EQ(compile("index.f -o law.so --debug").status, 0);
  const auto outcome = run_path(own_material("law.so", "[2e6, 0.25]", 0), shear, 1e3);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("of file index.f"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("of array 'stressnew' above upper bound of 6"), std::string::npos)
      << outcome.err;
}

} // namespace

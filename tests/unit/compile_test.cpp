// SPDX-License-Identifier: BSD-3-Clause
// What `simsand compile` reads from sources and from a compiler's messages, and the commands it makes.
#include "drivers/compile/compiler_advice.hpp"
#include "drivers/compile/compiler_command.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace {

using namespace drivers;

TEST(Compile, LanguageBySuffixAndDirective) {
  for (const auto* name : {"a.f", "a.for", "A.FOR", "a.ftn", "a.F"})
    EXPECT_EQ(language_of(name, ""), Language::fixed_fortran) << name;
  for (const auto* name : {"a.f90", "a.F90", "a.b.f95", "a.f03"})
    EXPECT_EQ(language_of(name, ""), Language::free_fortran) << name;
  EXPECT_EQ(language_of("a.c", ""), Language::c);
  for (const auto* name : {"a.C", "a.cpp", "a.cc", "a.cxx", "a.CPP"})
    EXPECT_EQ(language_of(name, ""), Language::cxx) << name;
  EXPECT_EQ(language_of("a.o", ""), Language::object);
  for (const auto* name : {"a", "a.txt", "for", "a.f/b"}) EXPECT_FALSE(language_of(name, "")) << name;
  EXPECT_EQ(language_of("a.for", "c\n!DEC$ FREEFORM\n"), Language::free_fortran);
  EXPECT_EQ(language_of("a.f", "!dir$ freeform\n"), Language::free_fortran);
  EXPECT_EQ(language_of("a.f90", "!DEC$ NOFREEFORM\n"), Language::fixed_fortran);
  EXPECT_EQ(language_of("a.f", "!     about DEC$ FREEFORM\n"), Language::fixed_fortran);
}

TEST(Compile, PreprocessorAndIncludes) {
  EXPECT_TRUE(needs_preprocessor("c\n#ifdef A\n"));
  EXPECT_TRUE(needs_preprocessor("# include <x>\n"));
  EXPECT_FALSE(needs_preprocessor("      x = '#if'\nc #if\n"));
  EXPECT_EQ(included_names("      INCLUDE 'VABA_PARAM.INC'\n"
                           "  include \"./more/a.f\"\n#include <SMAAspUserSubroutines.hdr>\n"
                           "c     include 'not.f'\n"),
            (std::vector<std::string>{"VABA_PARAM.INC", "a.f", "SMAAspUserSubroutines.hdr"}));
}

const std::string messages = "law.f:10:27:\n\n"
                             "   10 |       if (0.d0 .lt. x .lt. 1.d0) a(1) = 2\n"
                             "      |                           1\n"
                             "Error: The name 'lt' cannot be used as a defined operator at (1)\n"
                             "law.f:11:3:\n\n   11 |       x = y\n      |   1\nWarning: something\n"
                             "dir/law.f:6:10:\n\n"
                             "    6 |       if (0) then\n"
                             "      |          1\n"
                             "Error: IF clause at (1) requires a scalar LOGICAL expression\n"
                             "law.f:27:10:\n\n   27 |       use ifport\n      |          1\n"
                             "Fatal Error: Cannot open module file 'ifport.mod' for reading at (1): No such "
                             "file or directory\n"
                             "compilation terminated.\n";

TEST(Compile, ErrorsAreRead) {
  const auto errors = read_errors(messages);
  ASSERT_EQ(errors.size(), 3);
  EXPECT_EQ(errors[0].file, "law.f");
  EXPECT_EQ(errors[0].line, 10);
  EXPECT_EQ(errors[0].source, "       if (0.d0 .lt. x .lt. 1.d0) a(1) = 2");
  EXPECT_EQ(errors[1].file, "dir/law.f");
  EXPECT_EQ(errors[1].line, 6) << "the warning between is none";
  EXPECT_EQ(errors[2].line, 27);
}

TEST(Compile, AdviceNamesFileAndLine) {
  const auto lines = advice_on(messages);
  ASSERT_EQ(lines.size(), 3);
  EXPECT_EQ(lines[0].substr(0, 23), "law.f:10: `a < x < b` c") << lines[0];
  EXPECT_EQ(lines[1].substr(0, 42), "dir/law.f:6: a number stands for a conditi") << lines[1];
  EXPECT_NE(lines[2].find("law.f:27: the module comes with Intel's compiler"), std::string::npos);
  EXPECT_TRUE(advice_on("law.f:1:1:\n\n    1 |  x = = y\n\nError: Invalid expression at (1)\n").empty());
}

bool has(const Words& command, const std::string& word) {
  return std::find(command.begin(), command.end(), word) != command.end();
}

TEST(Compile, CommandsAreThoseOfAbaqus) {
  CompileOptions options;
  options.include_folders = {"my folder"};
  options.definitions = {"A=1"};
  SourceFile source{"law.for", Language::fixed_fortran};
  auto command = compiler_command(source, options, "inc", "tmp", "law.o");
  EXPECT_EQ(command.front(), "gfortran");
  for (const auto* word : {"-frecursive", "-ffixed-form", "-ffixed-line-length-132", "-fdec", "-O2", "-nocpp",
                           "-Imy folder", "-Iinc", "law.for"})
    EXPECT_TRUE(has(command, word)) << word;
  EXPECT_FALSE(has(command, "-DA=1")) << "without a preprocessor";
  source.preprocessed = options.debug = true;
  command = compiler_command(source, options, "inc", "tmp", "law.o");
  for (const auto* word : {"-cpp", "-DA=1", "-O0", "-g", "-finit-real=snan"})
    EXPECT_TRUE(has(command, word)) << word;
  EXPECT_FALSE(has(command, "-O2"));
  EXPECT_EQ(linker_command({source}, {"law.o"}, options, "x.so").front(), "gfortran");
  EXPECT_EQ(linker_command({{"a.c", Language::c}}, {"a.o"}, options, "x.so").front(), "gcc");
}

} // namespace

# SPDX-License-Identifier: BSD-3-Clause
# Conformance of the material to the calling convention, in both precisions: from C++, from Fortran, and as the
# single file compiled alone.
set(conformance_dir ${CMAKE_BINARY_DIR}/conformance)

# The single file as a user compiles it: no options of this project. And its sources with the same flags, whose
# numbers must be the same to the last bit.
set(plain_flags -O2 -ffp-contract=off)
foreach(precision dp sp)
  set(definition "")
  if(precision STREQUAL sp)
    set(definition SIMSAND_SINGLE)
  endif()
  set(compile_alone ${CMAKE_CXX_COMPILER} -std=c++17 -Wall -Wextra -Werror -fPIC -shared ${plain_flags}
    "$<$<BOOL:${definition}>:-D${definition}>")
  add_custom_command(OUTPUT ${conformance_dir}/single_file_${precision}.so
    COMMAND ${CMAKE_COMMAND} -E make_directory ${conformance_dir}
    COMMAND ${compile_alone} ${CMAKE_BINARY_DIR}/simsand_vumat.cpp -o ${conformance_dir}/single_file_${precision}.so
    DEPENDS ${CMAKE_BINARY_DIR}/simsand_vumat.cpp COMMAND_EXPAND_LISTS VERBATIM)
  add_library(vumat_plain_${precision} MODULE ${vumat_sources})
  set_target_properties(vumat_plain_${precision} PROPERTIES PREFIX "" OUTPUT_NAME plain_${precision}
    LIBRARY_OUTPUT_DIRECTORY ${conformance_dir} COMPILE_OPTIONS "-Wno-psabi;${plain_flags}"
    COMPILE_DEFINITIONS "${definition}")
endforeach()
# The branches for Windows and for compilers without GCC's vectors, as far as they can be tried here.
add_custom_command(OUTPUT ${conformance_dir}/single_file_windows.so
  COMMAND ${CMAKE_COMMAND} -E make_directory ${conformance_dir}
  COMMAND ${CMAKE_CXX_COMPILER} -std=c++17 -Wall -Wextra -Werror -fPIC -shared ${plain_flags} -include cstddef
    -D_WIN32 -D_MSC_VER=1930 "-D__declspec(x)=" ${CMAKE_BINARY_DIR}/simsand_vumat.cpp
    -o ${conformance_dir}/single_file_windows.so
  DEPENDS ${CMAKE_BINARY_DIR}/simsand_vumat.cpp VERBATIM)
add_custom_target(single_file_libraries ALL DEPENDS ${conformance_dir}/single_file_dp.so
  ${conformance_dir}/single_file_sp.so ${conformance_dir}/single_file_windows.so)
add_dependencies(single_file_libraries simsand_vumat_file)

add_tests(conformance_tests tests/conformance/arguments_test.cpp tests/conformance/precision_test.cpp
  tests/conformance/single_file_test.cpp)
add_dependencies(conformance_tests simsand_vumat_sp single_file_libraries vumat_plain_dp vumat_plain_sp)

# A Fortran caller, one program for each precision.
include(CheckLanguage)
check_language(Fortran)
if(CMAKE_Fortran_COMPILER)
  enable_language(Fortran)
  foreach(precision dp sp)
    add_executable(fortran_caller_${precision} tests/conformance/fortran_caller.f)
    target_include_directories(fortran_caller_${precision} PRIVATE
      ${CMAKE_SOURCE_DIR}/tests/conformance/include_${precision})
    set_target_properties(fortran_caller_${precision} PROPERTIES
      COMPILE_OPTIONS "-Wall;-Wextra;-Wno-compare-reals;-Wno-conversion;-Wno-unused-parameter;$<$<BOOL:${SIMSAND_WERROR}>:-Werror>")
    add_test(NAME fortran_caller_${precision} COMMAND fortran_caller_${precision})
  endforeach()
  target_link_libraries(fortran_caller_dp PRIVATE simsand_vumat)
  target_link_libraries(fortran_caller_sp PRIVATE simsand_vumat_sp)
else()
  message(STATUS "No Fortran compiler: the Fortran callers are not tested")
  add_test(NAME fortran_caller COMMAND ${CMAKE_COMMAND} -E echo "skipped: no Fortran compiler")
  set_tests_properties(fortran_caller PROPERTIES SKIP_REGULAR_EXPRESSION "skipped")
endif()

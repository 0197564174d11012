# SPDX-License-Identifier: BSD-3-Clause
# Materials for tests of the hosts: small VUMATs in C++ and, as users write them, in Fortran.
set(test_vumats "")
foreach(material elastic nan_after no_symbol throws needs_more)
  add_library(test_${material} SHARED tests/vumats/${material}.cpp)
  set_target_properties(test_${material} PROPERTIES OUTPUT_NAME ${material}
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/test_vumats)
  list(APPEND test_vumats test_${material})
endforeach()
# Compiled as host/VUMAT_HOST.md tells users to. Warnings are off: one of them breaks rules on purpose.
if(CMAKE_Fortran_COMPILER)
  foreach(material elastic j2 audit misbehaves)
    add_library(test_${material}_f MODULE tests/vumats/${material}.f)
    target_include_directories(test_${material}_f PRIVATE ${CMAKE_SOURCE_DIR}/host/fortran)
    set_target_properties(test_${material}_f PROPERTIES PREFIX "" OUTPUT_NAME ${material}
      LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/test_vumats COMPILE_OPTIONS "-O2;-std=legacy;-w")
    list(APPEND test_vumats test_${material}_f)
  endforeach()
endif()

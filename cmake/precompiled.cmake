# SPDX-License-Identifier: Apache-2.0
# Headers that most files include, compiled once: a small file takes half the time. Files
# include what they use all the same (tools/check_tidy reads them without), and
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
function(skein_precompile name)
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_precompile_headers(${name} PRIVATE ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen fmt::fmt)
endfunction()

# Tests are run once: what the compiler takes to make them fast is not worth it.
function(skein_optimise_as_test target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Twice: for what lies below the values of data/, and with them for all that stands on it.
# src/skein/CMakeLists.txt says from where on by SKEIN_PRECOMPILED, "" or "_data".
set(SKEIN_PRECOMPILED "")
foreach(part "" _data)
  set(headers ${PROJECT_SOURCE_DIR}/cmake/precompiled${part}.h)
  skein_precompile(skein_precompiled${part} ${headers})
  if(SKEIN_TESTS)
    skein_precompile(skein_precompiled_tests${part} ${headers} <gtest/gtest.h>)
    target_link_libraries(skein_precompiled_tests${part} PRIVATE GTest::gtest)
    skein_optimise_as_test(skein_precompiled_tests${part})
  endif()
endforeach()

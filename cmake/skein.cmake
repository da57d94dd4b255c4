# SPDX-License-Identifier: Apache-2.0
# One call per folder: a library skein_<name>, its tests as one program <name>_test.
#
#   skein_module(<name> SOURCES a.cpp... TESTS test/a_test.cpp...
#                NEEDS <modules and public libraries>... HIDES <private libraries>...)
#
# NEEDS entries that are modules of this project are linked as skein_<entry>. TEST_ONLY
# modules are tests of several others together; they are not installed.

# Source files of a target are compiled together, some at a time: what they include is read
# once, and building the program takes 0.6 of the time (docs/building.md). Names of an
# anonymous namespace are therefore unique within a folder; each test has a namespace of its
# own around it, skein::...::<file>.
function(skein_unity target)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${SKEIN_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# Libraries without anything to link: those who use ours need not have them.
set(SKEIN_HEADER_ONLY skein_warnings nlohmann_json::nlohmann_json)

function(skein_link target visibility)
  foreach(need IN LISTS ARGN)
    if(visibility STREQUAL PRIVATE AND need IN_LIST SKEIN_HEADER_ONLY)
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${need}>)
    elseif(TARGET skein_${need})
      target_link_libraries(${target} ${visibility} skein_${need})
    else()
      target_link_libraries(${target} ${visibility} ${need})
    endif()
  endforeach()
endfunction()

function(skein_module name)
  cmake_parse_arguments(ARG TEST_ONLY "" "SOURCES;TESTS;NEEDS;HIDES;TEST_NEEDS" ${ARGN})
  if(ARG_SOURCES)
    add_library(skein_${name} STATIC ${ARG_SOURCES})
    skein_export(${name} PUBLIC)
    skein_link(skein_${name} PUBLIC ${ARG_NEEDS})
    skein_link(skein_${name} PRIVATE skein_warnings ${ARG_HIDES})
    target_precompile_headers(skein_${name} REUSE_FROM skein_precompiled${SKEIN_PRECOMPILED})
    skein_unity(skein_${name})
  else()
    add_library(skein_${name} INTERFACE)
    if(NOT ARG_TEST_ONLY)
      skein_export(${name} INTERFACE)
    endif()
    skein_link(skein_${name} INTERFACE ${ARG_NEEDS})
  endif()
  if(ARG_TESTS AND SKEIN_TESTS)
    add_executable(${name}_test ${ARG_TESTS})
    skein_link(${name}_test PRIVATE ${name} ${ARG_TEST_NEEDS} skein_warnings GTest::gtest_main)
    target_precompile_headers(${name}_test REUSE_FROM skein_precompiled_tests${SKEIN_PRECOMPILED})
    skein_optimise_as_test(${name}_test)
    skein_unity(${name}_test)
    # They replace operator new, and the compiler warns where it inlines that elsewhere.
    set(counting ${ARG_TESTS})
    list(FILTER counting INCLUDE REGEX "/allocations?(_test)?\\.cpp$")
    set_source_files_properties(${counting} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
      COMPILE_OPTIONS -Wno-mismatched-new-delete)
    target_compile_definitions(${name}_test PRIVATE
      SKEIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
      SKEIN_SHARED_DATA="${SKEIN_SHARED_DATA}")
    gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
                         # Properties are drawn from one seed, so that a failure repeats.
                         PROPERTIES TIMEOUT 300 ENVIRONMENT RC_PARAMS=seed=2018)
  endif()
endfunction()

# skein_bench(<name> SOURCES... NEEDS...): a Google Benchmark program bench_<name>.
function(skein_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;NEEDS" ${ARGN})
  if(SKEIN_BENCH)
    add_executable(bench_${name} ${ARG_SOURCES})
    skein_link(bench_${name} PRIVATE ${ARG_NEEDS} skein_warnings benchmark::benchmark_main)
    target_precompile_headers(bench_${name} REUSE_FROM skein_precompiled${SKEIN_PRECOMPILED})
    target_compile_definitions(bench_${name} PRIVATE
      SKEIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}" SKEIN_SHARED_DATA="${SKEIN_SHARED_DATA}")
  endif()
endfunction()

# skein_fuzz(<name> SOURCES... NEEDS...): a libFuzzer program fuzz_<name> (clang only).
function(skein_fuzz name)
  cmake_parse_arguments(ARG "" "" "SOURCES;NEEDS" ${ARGN})
  if(SKEIN_FUZZ)
    add_executable(fuzz_${name} ${ARG_SOURCES})
    skein_link(fuzz_${name} PRIVATE ${ARG_NEEDS} skein_warnings)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  endif()
endfunction()

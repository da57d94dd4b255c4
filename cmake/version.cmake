# SPDX-License-Identifier: Apache-2.0
# Writes OUT, a small source file with the version and the build, when it has changed.
#
#   cmake -DSOURCE=... -DVERSION=0.1.0 -DIN=version.cpp.in -DOUT=version.cpp -P version.cmake
find_package(Git QUIET)
set(build "")
if(GIT_FOUND)
  # A copy unpacked inside another repository is not described by that repository.
  execute_process(COMMAND ${GIT_EXECUTABLE} ls-files --error-unmatch CMakeLists.txt
                  WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(status EQUAL 0)
    # Without locks, so that a build never disturbs a commit that is being made.
    execute_process(COMMAND ${GIT_EXECUTABLE} --no-optional-locks describe --always --abbrev=10
                            --dirty=.dirty --match=none
                    WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE status
                    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(status EQUAL 0)
      set(build "+g${commit}")
    endif()
  endif()
endif()
if(NOT build)
  file(GLOB_RECURSE files ${SOURCE}/src/* ${SOURCE}/app/* ${SOURCE}/web/common/* ${SOURCE}/web/live/*
       ${SOURCE}/web/report/* ${SOURCE}/web/plan/*)
  list(SORT files)
  set(all "")
  foreach(each IN LISTS files)
    file(SHA256 ${each} hash)
    string(APPEND all ${hash})
  endforeach()
  string(SHA256 hash "${all}")
  string(SUBSTRING ${hash} 0 10 hash)
  set(build "+src${hash}")
endif()
set(SKEIN_VERSION "${VERSION}${build}")
configure_file(${IN} ${OUT} @ONLY)

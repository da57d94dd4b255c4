# SPDX-License-Identifier: Apache-2.0
# Elementary functions that are the same on every processor: the members of musl's static
# library that define them, taken out at configuration.

set(SKEIN_ELEMENTARY_FUNCTIONS
    sin cos tan asin acos atan atan2 sinh cosh tanh exp exp2 expm1 log log1p log2 log10 pow
    hypot cbrt erf erfc)
# Besides these, what shared libraries take from the system.
set(SKEIN_SYSTEM_FUNCTIONS
    ${SKEIN_ELEMENTARY_FUNCTIONS} sincos asinh acosh atanh exp10 sinf cosf sincosf tanf asinf
    acosf atanf atan2f sinhf coshf tanhf expf exp2f expm1f logf log1pf log2f log10f powf
    hypotf cbrtf)

find_file(SKEIN_MUSL_LIBC libc.a REQUIRED NO_DEFAULT_PATH
          PATHS /usr/lib/${CMAKE_SYSTEM_PROCESSOR}-linux-musl /usr/lib/musl/lib
          DOC "musl's static C library (package musl-dev)")

# skein_extract(<object> <functions>...): the functions and all that they need, in one
# object file; sets `symbols` to the names that it defines. Made again when musl or this
# file is newer.
function(skein_extract object)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  list(TRANSFORM ARGN PREPEND "-Wl,-u," OUTPUT_VARIABLE undefined)
  # By the compiler, who tells any linker for which processor it is.
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -nostdlib -r ${undefined} -o ${object}
                          ${SKEIN_MUSL_LIBC} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_NM} -g --defined-only -f posix ${object}
                  OUTPUT_VARIABLE defined COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE " [^\n]*" "" defined "${defined}")
  set(symbols "${defined}" PARENT_SCOPE)
  # What is left undefined would be taken from another library.
  execute_process(COMMAND ${CMAKE_NM} -u -f posix ${object} OUTPUT_VARIABLE missing
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "_GLOBAL_OFFSET_TABLE_ [^\n]*\n" "" missing "${missing}")
  if(missing)
    message(FATAL_ERROR "${SKEIN_MUSL_LIBC}: its functions also need ${missing}")
  endif()
endfunction()

# Whether `object` is newer than what it is made of.
function(skein_is_made object variable)
  set(${variable} FALSE PARENT_SCOPE)
  if(EXISTS ${object} AND ${object} IS_NEWER_THAN ${SKEIN_MUSL_LIBC}
     AND ${object} IS_NEWER_THAN ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
    set(${variable} TRUE PARENT_SCOPE)
  endif()
endfunction()

# skein_elementary_functions(<variable>): sets <variable> to an object file in which every
# name starts with skein_, so that they live beside the system's
# (src/skein/base/math.h).
function(skein_elementary_functions variable)
  set(object ${PROJECT_BINARY_DIR}/lib/elementary_functions.o)
  set(${variable} ${object} PARENT_SCOPE)
  skein_is_made(${object} made)
  if(made)
    return()
  endif()
  skein_extract(${object}.joined ${SKEIN_ELEMENTARY_FUNCTIONS})
  string(REGEX REPLACE "([^\n]+)" "\\1 skein_\\1" renamed "${symbols}")
  file(WRITE ${object}.names "${renamed}")
  execute_process(COMMAND ${CMAKE_OBJCOPY} --redefine-syms ${object}.names
                          ${object}.joined ${object} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# skein_replace_system_functions(<program>): the program has sin, cos, exp... of its own
# under the system's names, and shows them to the shared libraries that it loads (PROJ,
# GDAL, GeographicLib, a user's own kinds), which then use them instead of the system's:
# the dynamic linker looks into the program first. So what they compute does not depend on
# the processor either.
function(skein_replace_system_functions program)
  set(object ${PROJECT_BINARY_DIR}/lib/system_functions.o)
  skein_is_made(${object} made)
  if(NOT made)
    skein_extract(${object}.joined ${SKEIN_SYSTEM_FUNCTIONS})
    list(JOIN SKEIN_SYSTEM_FUNCTIONS "\n" kept)
    file(WRITE ${object}.names "${kept}\n")
    list(JOIN SKEIN_SYSTEM_FUNCTIONS "; " shown)
    file(WRITE ${object}.shown "{ ${shown}; };\n")
    execute_process(COMMAND ${CMAKE_OBJCOPY} --keep-global-symbols=${object}.names
                            ${object}.joined ${object} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  target_sources(${program} PRIVATE ${object})
  target_link_options(${program} PRIVATE LINKER:--dynamic-list=${object}.shown)
endfunction()

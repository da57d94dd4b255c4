# Elementary functions that are the same on every processor (src/skein/base/math.h): the
# members of musl's static library that define them, as one object file in which every name
# starts with skein_, so that they live beside the system's.
#
#   skein_elementary_functions(<variable>)   sets <variable> to the object file
function(skein_elementary_functions variable)
  find_file(SKEIN_MUSL_LIBC libc.a REQUIRED NO_DEFAULT_PATH
            PATHS /usr/lib/${CMAKE_SYSTEM_PROCESSOR}-linux-musl /usr/lib/musl/lib
            DOC "musl's static C library (package musl-dev)")
  set(object ${PROJECT_BINARY_DIR}/lib/elementary_functions.o)
  set(${variable} ${object} PARENT_SCOPE)
  if(EXISTS ${object} AND ${object} IS_NEWER_THAN ${SKEIN_MUSL_LIBC}
     AND ${object} IS_NEWER_THAN ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
    return()
  endif()
  set(wanted)
  foreach(name sin cos tan asin acos atan atan2 sinh cosh tanh exp exp2 expm1 log log1p
               log2 log10 pow hypot cbrt erf erfc)
    list(APPEND wanted -u ${name})
  endforeach()
  set(joined ${object}.joined)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  execute_process(COMMAND ${CMAKE_LINKER} -r ${wanted} -o ${joined} ${SKEIN_MUSL_LIBC}
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_NM} -g --defined-only -f posix ${joined}
                  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "([^ \n]+) [^\n]*" "\\1 skein_\\1" renamed "${symbols}")
  file(WRITE ${object}.names "${renamed}")
  execute_process(COMMAND ${CMAKE_OBJCOPY} --redefine-syms ${object}.names ${joined} ${object}
                  COMMAND_ERROR_IS_FATAL ANY)
  # What is left undefined would be taken from another library.
  execute_process(COMMAND ${CMAKE_NM} -u -f posix ${object} OUTPUT_VARIABLE missing)
  string(REGEX REPLACE "_GLOBAL_OFFSET_TABLE_ [^\n]*\n" "" missing "${missing}")
  if(missing)
    message(FATAL_ERROR "${SKEIN_MUSL_LIBC}: its functions also need ${missing}")
  endif()
endfunction()

# SPDX-License-Identifier: Apache-2.0
# Fetches the npm packages of a folder when they are missing or its lock file has changed.
# Several build folders share its node_modules, hence the lock.
#   cmake -DWEB=<folder: web, tools/interop> -DNPM=<npm> -P install.cmake
file(LOCK ${WEB}/.install.lock TIMEOUT 300)
file(SHA256 ${WEB}/package-lock.json wanted)
set(stamp ${WEB}/node_modules/.skein-lock-hash)
set(present "")
if(EXISTS ${stamp})
  file(READ ${stamp} present)
endif()
# Packages that somebody else installed (an unpacked archive, a machine without network)
# are good if npm finds them complete.
if(present STREQUAL "" AND EXISTS ${WEB}/node_modules)
  execute_process(COMMAND ${NPM} ls --offline WORKING_DIRECTORY ${WEB}
                  RESULT_VARIABLE incomplete OUTPUT_QUIET ERROR_QUIET)
  if(NOT incomplete)
    set(present ${wanted})
    file(WRITE ${stamp} ${wanted})
  endif()
endif()
if(NOT present STREQUAL wanted)
  execute_process(COMMAND ${NPM} ci --no-progress --loglevel=error WORKING_DIRECTORY ${WEB}
                  RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "npm ci failed in ${WEB}: the packages of package-lock.json are "
                        "needed, from the network or npm's cache.")
  endif()
  file(WRITE ${stamp} ${wanted})
endif()

# SPDX-License-Identifier: Apache-2.0
# Writes OUT with the version and a hash of all headers in SOURCE that are installed.
#
#   cmake -DSOURCE=src -DVERSION=0.1.0 -DIN=interface_version.h.in -DOUT=... -P ...
file(GLOB_RECURSE headers RELATIVE ${SOURCE} ${SOURCE}/*.h)
list(FILTER headers EXCLUDE REGEX "/(test|fuzz)/")
list(SORT headers)
set(all "")
foreach(header IN LISTS headers)
  file(SHA256 ${SOURCE}/${header} hash)
  string(APPEND all "${header} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 12 SKEIN_HEADERS)
set(SKEIN_VERSION ${VERSION})
configure_file(${IN} ${OUT} @ONLY)

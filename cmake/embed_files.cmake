# SPDX-License-Identifier: Apache-2.0
# Writes OUT, a C++ file with the texts of FILES (a list of files of one folder that end
# in ENDING) in a table, by name.
#
#   cmake "-DFILES=a.yaml;b.yaml" -DENDING=.yaml -DIN=table.cpp.in -DOUT=table.cpp
#         -P embed_files.cmake
set(names "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME_WLE)
  get_filename_component(folder ${file} DIRECTORY)
  list(APPEND names ${name})
endforeach()
list(SORT names)
set(rows "")
foreach(name IN LISTS names)
  file(READ ${folder}/${name}${ENDING} text)
  string(APPEND rows "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
set(SKEIN_EMBEDDED_ROWS "${rows}")
configure_file(${IN} ${OUT} @ONLY)

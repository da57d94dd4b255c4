# SPDX-License-Identifier: Apache-2.0
# skein::plugin: what a shared library with kinds of its own is compiled with. It has
# headers and flags but no archives, because the program that loads it holds the library.
if(NOT TARGET skein::plugin)
  add_library(skein::plugin INTERFACE IMPORTED GLOBAL)
  foreach(property INCLUDE_DIRECTORIES SYSTEM_INCLUDE_DIRECTORIES COMPILE_OPTIONS
                   COMPILE_DEFINITIONS COMPILE_FEATURES)
    set_property(TARGET skein::plugin PROPERTY INTERFACE_${property}
                 $<TARGET_PROPERTY:skein::skein,INTERFACE_${property}>)
  endforeach()
  set_property(TARGET skein::plugin PROPERTY INTERFACE_LINK_LIBRARIES fmt::fmt)
endif()

# SPDX-License-Identifier: Apache-2.0
# What other projects get of Skein, by `cmake --install` and find_package(skein) or by
# add_subdirectory(): one library skein::<module> per folder, skein::skein for all of them,
# skein::plugin for shared libraries with kinds of one's own (docs/extending.md).
include(GNUInstallDirs)

# skein_export(<module> <visibility>): the library skein_<module> as others see it.
# Its users look for headers where it does, and compute as it does.
function(skein_export name visibility)
  target_include_directories(skein_${name} ${visibility}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(skein_${name} INTERFACE cxx_std_20)
  target_compile_options(skein_${name} INTERFACE -ffp-contract=off)
  add_library(skein::${name} ALIAS skein_${name})
  set_target_properties(skein_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY SKEIN_MODULES skein_${name})
endfunction()

# skein_load_plugins(<program>): the program holds all of the library and shows it to the
# plugins that it loads, so that library and plugins share one copy of everything.
function(skein_load_plugins program)
  get_property(modules GLOBAL PROPERTY SKEIN_MODULES)
  target_link_libraries(${program} PRIVATE ${modules})
  set(archives "")
  foreach(module IN LISTS modules)
    get_target_property(type ${module} TYPE)
    if(type STREQUAL STATIC_LIBRARY)
      string(APPEND archives ",$<TARGET_FILE:${module}>")
    endif()
  endforeach()
  target_link_libraries(${program} PRIVATE ${CMAKE_DL_LIBS})
  target_link_options(${program} PRIVATE
    LINKER:--whole-archive${archives},--no-whole-archive
    LINKER:--dynamic-list=${PROJECT_SOURCE_DIR}/cmake/plugin_symbols.txt)
endfunction()

# skein_install_library(): after all modules are known.
function(skein_install_library)
  get_property(modules GLOBAL PROPERTY SKEIN_MODULES)
  add_library(skein_all INTERFACE)
  target_link_libraries(skein_all INTERFACE ${modules})
  set_target_properties(skein_all PROPERTIES EXPORT_NAME skein)
  add_library(skein::skein ALIAS skein_all)
  include(${PROJECT_SOURCE_DIR}/cmake/skein-plugin.cmake)
  if(NOT SKEIN_INSTALL)
    return()
  endif()
  include(CMakePackageConfigHelpers)
  set(package ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
  install(TARGETS ${modules} skein_all EXPORT skein-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/skein COMPONENT development)
  install(EXPORT skein-targets NAMESPACE skein:: DESTINATION ${package} COMPONENT development)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/skein ${PROJECT_BINARY_DIR}/include/skein
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
          FILES_MATCHING PATTERN *.h PATTERN test EXCLUDE PATTERN fuzz EXCLUDE)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/skein-config.cmake.in
                                ${PROJECT_BINARY_DIR}/skein-config.cmake
                                INSTALL_DESTINATION ${package})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/skein-config-version.cmake
                                   COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/skein-config.cmake
                ${PROJECT_BINARY_DIR}/skein-config-version.cmake
                ${PROJECT_SOURCE_DIR}/cmake/skein-plugin.cmake
          DESTINATION ${package} COMPONENT development)
endfunction()

# skein_install_program(): the program and what belongs to it. Aircraft files and the pages
# of reports are part of it.
function(skein_install_program)
  if(NOT SKEIN_INSTALL)
    return()
  endif()
  install(TARGETS skein RUNTIME COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/skein
          COMPONENT program PATTERN expect EXCLUDE)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/campaigns DESTINATION ${CMAKE_INSTALL_DATADIR}/skein
          COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/aircraft DESTINATION ${CMAKE_INSTALL_DATADIR}/skein
          COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}
          COMPONENT program)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
                ${PROJECT_SOURCE_DIR}/CHANGES.md
          DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endfunction()

# What is installed: the libraries, their headers, the CMake package and the pkg-config files, and the command's
# completion and manual page (tools/ installs the command). The kernels are inside the library.
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/VoroCL)

install(TARGETS vorocl EXPORT VoroCLTargets)
install(EXPORT VoroCLTargets NAMESPACE VoroCL:: DESTINATION ${package_folder})
install(DIRECTORY include/vorocl ${CMAKE_CURRENT_BINARY_DIR}/include/vorocl TYPE INCLUDE
        PATTERN picture.hpp EXCLUDE PATTERN mpi.hpp EXCLUDE)

# Two export files, so that who uses the core alone needs no OpenCV.
set(pkgconfig_files vorocl)
if(VOROCL_BUILD_PICTURE)
  install(TARGETS vorocl_picture EXPORT VoroCLPictureTargets)
  install(EXPORT VoroCLPictureTargets NAMESPACE VoroCL:: DESTINATION ${package_folder})
  install(FILES include/vorocl/picture.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vorocl)
  list(APPEND pkgconfig_files vorocl-picture)
endif()

if(VOROCL_MPI)
  install(TARGETS vorocl_mpi EXPORT VoroCLMpiTargets)
  install(EXPORT VoroCLMpiTargets NAMESPACE VoroCL:: DESTINATION ${package_folder})
  install(FILES include/vorocl/mpi.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vorocl)
endif()

set(library_is_static TRUE)
list(TRANSFORM cxx_runtime PREPEND " -l" OUTPUT_VARIABLE static_needs)
list(JOIN static_needs "" static_needs)
string(APPEND static_needs " -pthread")
if(BUILD_SHARED_LIBS)
  set(library_is_static FALSE)
  set(static_needs)
endif()

configure_package_config_file(cmake/VoroCLConfig.cmake.in VoroCLConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(VoroCLConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/VoroCLConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/VoroCLConfigVersion.cmake
        DESTINATION ${package_folder})

# Relative to themselves, so that an installed copy can be moved (and `cmake --install --prefix` works).
file(RELATIVE_PATH prefix_from_pkgconfig ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig "${prefix_from_pkgconfig}")
foreach(name IN LISTS pkgconfig_files)
  configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

if(VOROCL_BUILD_TOOLS)
  install(FILES tools/vorocl.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME vorocl)
  install(FILES docs/vorocl.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# cmake --install: the program, and the libraries with their public headers for
# find_package(lego_loam_sc). Component `program` and component `development` are the two Debian
# packages, see Package.cmake.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lego_loam_sc)

if(LEGO_LOAM_SC_PROGRAM)
  install(TARGETS lego-loam-sc COMPONENT program)
endif()

set_target_properties(lego_loam_sc_io PROPERTIES EXPORT_NAME io)
install(TARGETS lego_loam_sc lego_loam_sc_io EXPORT lego_loam_sc_targets
        ARCHIVE COMPONENT development INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT lego_loam_sc_targets NAMESPACE lego_loam_sc:: DESTINATION ${package_dir}
        COMPONENT development)

configure_package_config_file(cmake/lego_loam_sc-config.cmake.in lego_loam_sc-config.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change what a caller sees.
write_basic_package_version_file(lego_loam_sc-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lego_loam_sc-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/lego_loam_sc-config-version.cmake cmake/FindGTSAM.cmake
        DESTINATION ${package_dir} COMPONENT development)

install(CODE "
  set(source \"${CMAKE_CURRENT_SOURCE_DIR}/src\")
  set(destination \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/lego_loam_sc\")
  include(\"${CMAKE_CURRENT_SOURCE_DIR}/cmake/InstallHeaders.cmake\")" COMPONENT development)

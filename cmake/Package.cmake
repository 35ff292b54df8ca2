# cpack -G DEB in the build folder: lego-loam-sc, the program, and liblego-loam-sc-dev, the libraries
# to build against. See docs/library.md.
set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_CONTACT "The LeGO-LOAM-SC authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME lego-loam-sc)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What follows the first line, which is the project's.
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
    "The program: trajectory and map from a folder of scans, a KITTI sequence or a scan stream.")

# Static libraries: what they are linked with cannot be found in them.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblego-loam-sc-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev (>= 3.4), libtbb-dev, libgtsam-dev, libyaml-cpp-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "Libraries and headers for find_package(lego_loam_sc): the SLAM, readers and writers of files.")

foreach(component program development)
  string(TOUPPER ${component} upper)
  install(FILES LICENSE DESTINATION
          ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}
          RENAME copyright COMPONENT ${component})
endforeach()
include(CPack)

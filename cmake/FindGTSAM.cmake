# Finds GTSAM by header and library. Debian's GTSAMConfig.cmake names a library that is not
# packaged (libCppUnitLite.a) and Boost components that we do not need.
find_path(GTSAM_INCLUDE_DIR gtsam/nonlinear/ISAM2.h)
find_library(GTSAM_LIBRARY gtsam)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GTSAM REQUIRED_VARS GTSAM_LIBRARY GTSAM_INCLUDE_DIR)
if(GTSAM_FOUND AND NOT TARGET GTSAM::GTSAM)
  add_library(GTSAM::GTSAM UNKNOWN IMPORTED)
  set_target_properties(GTSAM::GTSAM PROPERTIES IMPORTED_LOCATION ${GTSAM_LIBRARY}
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${GTSAM_INCLUDE_DIR})
  target_link_libraries(GTSAM::GTSAM INTERFACE Eigen3::Eigen TBB::tbb)
endif()
mark_as_advanced(GTSAM_INCLUDE_DIR GTSAM_LIBRARY)

# Run while installing: copies the public headers (paths below `source`) and what they include to
# `destination`. Sources include "slam/slam.hpp"; installed headers, in a folder that others share,
# say "lego_loam_sc/slam/slam.hpp".
cmake_minimum_required(VERSION 3.25)
set(headers
  slam/slam.hpp slam/match_scans.hpp key_frames/map_cloud.hpp loop/scan_context.hpp
  io/scan_source.hpp io/sensor_presets.hpp io/sensor_yaml.hpp io/settings_yaml.hpp
  io/trajectory.hpp io/cloud_writer.hpp core/error.hpp core/time.hpp)
set(done)
while(headers)
  list(POP_FRONT headers header)
  if(header IN_LIST done)
    continue()
  endif()
  list(APPEND done ${header})
  file(READ "${source}/${header}" text)
  string(REGEX MATCHALL "#include \"[^\"]+\"" includes "${text}")
  list(TRANSFORM includes REPLACE "#include \"([^\"]+)\"" "\\1")
  list(APPEND headers ${includes})
  string(REPLACE "#include \"" "#include \"lego_loam_sc/" text "${text}")
  # Only what has changed is written, so that nothing is built anew for nothing.
  file(CONFIGURE OUTPUT "${destination}/${header}" CONTENT "${text}" @ONLY NEWLINE_STYLE UNIX)
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${destination}/${header}")
endwhile()

# Most of our files take longer to read their headers than to compile. Off unless asked for (the
# scripts do): a compiler cache shares less of what is built so, a change of one file compiles its
# neighbours, and no file may rely on what another one includes.
option(AQC_FAST_BUILD "Compile libraries in batches of files and tests with precompiled headers" OFF)

# The files of each folder of TARGET as one: what they name in namespaces of their own must differ.
function(aqc_batch target)
  if(NOT AQC_FAST_BUILD OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    get_filename_component(folder ${folder} NAME)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# HEADERS as after #include, beside those that all files share.
function(aqc_precompile target)
  if(AQC_FAST_BUILD)
    target_precompile_headers(${target} PRIVATE <Eigen/Dense> <algorithm> <array> <cmath> <functional>
      <map> <memory> <optional> <sstream> <string> <utility> <variant> <vector> ${ARGN})
  endif()
endfunction()

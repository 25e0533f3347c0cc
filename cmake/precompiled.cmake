# Precompiled headers. Eigen, roscpp and gtest take longer to read than most of our files take to
# compile. Off unless asked for (the scripts do), since
# a compiler cache shares less of what is built so; no file relies on them.
option(AQC_PRECOMPILED_HEADERS "Read Eigen, roscpp and gtest once for each target" OFF)

# aqc_precompile(TARGET HEADERS...): HEADERS as after #include, beside those that all files share.
function(aqc_precompile target)
  if(AQC_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE <Eigen/Dense> <algorithm> <array> <cmath> <functional>
      <map> <memory> <optional> <sstream> <string> <utility> <variant> <vector> ${ARGN})
  endif()
endfunction()

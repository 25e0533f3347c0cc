# Finds what is out of bounds, undefined or raced for. A fault ends the program. The core's tests:
#   cmake -S . -B build/asan -DAQC_ROS=OFF -DAQC_TESTS=ON -DAQC_TOOLS=OFF
#     "-DAQC_SANITIZE=address;undefined" -DCMAKE_BUILD_TYPE=RelWithDebInfo
#   cmake --build build/asan && ctest --test-dir build/asan --output-on-failure -R _tests
set(AQC_SANITIZE "" CACHE STRING
  "Build with address, undefined, thread, or the list \"address;undefined\"; empty: none")
foreach(sanitizer ${AQC_SANITIZE})
  if(NOT sanitizer MATCHES "^(address|undefined|thread)$")
    message(FATAL_ERROR
      "AQC_SANITIZE is '${AQC_SANITIZE}'; it must be of address, undefined and thread")
  endif()
  add_compile_options(-fsanitize=${sanitizer})
  add_link_options(-fsanitize=${sanitizer})
endforeach()
if("address" IN_LIST AQC_SANITIZE AND "thread" IN_LIST AQC_SANITIZE)
  message(FATAL_ERROR "AQC_SANITIZE is '${AQC_SANITIZE}'; address and thread exclude each other")
endif()
if(AQC_SANITIZE)
  # Eigen's assertions belong to it; -O1 keeps the tests fast and their compilation too.
  add_compile_options(-fno-sanitize-recover=all -fno-omit-frame-pointer -g1 -O1 -UNDEBUG)
endif()
if(AQC_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "AQC_FUZZ is ON, but only clang has libFuzzer: -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)  # tells the fuzzer where an input goes
endif()

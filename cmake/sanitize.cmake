# -DAQC_SANITIZE=address|undefined|thread, or "address;undefined", which go together. A fault ends
# the program.
set(AQC_SANITIZE "" CACHE STRING "Sanitizers to build with: address, undefined, thread; none: empty")
foreach(sanitizer ${AQC_SANITIZE})
  if(NOT sanitizer MATCHES "^(address|undefined|thread)$")
    message(FATAL_ERROR
      "AQC_SANITIZE is '${AQC_SANITIZE}'; it must be of address, undefined and thread")
  endif()
  add_compile_options(-fsanitize=${sanitizer} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${sanitizer})
endforeach()

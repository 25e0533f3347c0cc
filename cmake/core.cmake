# The core: plain C++, no ROS. A new file in one of its folders needs no line here.

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)

set(core_sources)
foreach(folder math parameters model reference law flight pilot simulation)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${folder}/*.cpp)
  list(APPEND core_sources ${files})
endforeach()
add_library(aqc_core ${core_sources})
target_include_directories(aqc_core
  PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
  PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_compile_features(aqc_core PUBLIC cxx_std_17)
target_link_libraries(aqc_core PUBLIC Eigen3::Eigen yaml-cpp)

# Whoever wants the core alone: find_package(aqc_core), target aqc::core.
include(CMakePackageConfigHelpers)
set(core_package ${AQC_LIB_DESTINATION}/cmake/aqc_core)
set_target_properties(aqc_core PROPERTIES EXPORT_NAME core)
install(TARGETS aqc_core EXPORT aqc_core
  ARCHIVE DESTINATION ${AQC_LIB_DESTINATION}
  LIBRARY DESTINATION ${AQC_LIB_DESTINATION}
  RUNTIME DESTINATION ${AQC_BIN_DESTINATION})
install(EXPORT aqc_core NAMESPACE aqc:: FILE aqc_core-targets.cmake DESTINATION ${core_package})
configure_package_config_file(cmake/aqc_core-config.cmake.in aqc_core-config.cmake
  INSTALL_DESTINATION ${core_package})
write_basic_package_version_file(aqc_core-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/aqc_core-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/aqc_core-config-version.cmake DESTINATION ${core_package})
install(DIRECTORY include/${PROJECT_NAME} DESTINATION ${AQC_INCLUDE_DESTINATION})

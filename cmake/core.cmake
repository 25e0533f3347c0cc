# The core: plain C++, no ROS. A new file in one of its folders needs no line here.

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
aqc_batch(aqc_core)

# Whoever wants the core alone: find_package(aqc_core), target aqc::core; examples/ does. To install
# nothing else: cmake --install build --component core.
add_library(aqc::core ALIAS aqc_core)
set_target_properties(aqc_core PROPERTIES EXPORT_NAME core)
install(TARGETS aqc_core EXPORT aqc_core
  ARCHIVE DESTINATION ${AQC_LIB_DESTINATION} COMPONENT core
  LIBRARY DESTINATION ${AQC_LIB_DESTINATION} COMPONENT core
  RUNTIME DESTINATION ${AQC_BIN_DESTINATION} COMPONENT core)
install(DIRECTORY include/${PROJECT_NAME} DESTINATION ${AQC_INCLUDE_DESTINATION} COMPONENT core)
install(DIRECTORY config DESTINATION ${AQC_SHARE_DESTINATION} COMPONENT core)

include(CMakePackageConfigHelpers)
set(core_package ${AQC_LIB_DESTINATION}/cmake/aqc_core)
set(core_config ${CMAKE_CURRENT_BINARY_DIR}/aqc_core-config.cmake)
set(core_version ${CMAKE_CURRENT_BINARY_DIR}/aqc_core-config-version.cmake)
install(EXPORT aqc_core NAMESPACE aqc:: FILE aqc_core-targets.cmake DESTINATION ${core_package}
  COMPONENT core)
configure_package_config_file(cmake/aqc_core-config.cmake.in ${core_config}
  INSTALL_DESTINATION ${core_package})
write_basic_package_version_file(${core_version} COMPATIBILITY SameMinorVersion)
#catkin_lint: ignore_once missing_file -- written just above
install(FILES ${core_config} ${core_version} DESTINATION ${core_package} COMPONENT core)
if(AQC_ROS)
  # The same for the devel space of a catkin workspace.
  set(core_package ${CATKIN_DEVEL_PREFIX}/lib/cmake/aqc_core)
  export(EXPORT aqc_core NAMESPACE aqc:: FILE ${core_package}/aqc_core-targets.cmake)
  file(COPY ${core_config} ${core_version} DESTINATION ${core_package})
endif()

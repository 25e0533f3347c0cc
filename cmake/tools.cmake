# What people look at: tables and files (report), figures, and the command-line programs.

file(GLOB report_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/report/*.cpp)
add_library(aqc_report ${report_sources})
target_compile_definitions(aqc_report PRIVATE AQC_SOURCE_CONFIG="${PROJECT_SOURCE_DIR}/config")
target_include_directories(aqc_report PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
target_link_libraries(aqc_report PUBLIC aqc_core nlohmann_json::nlohmann_json)
aqc_batch(aqc_report)

file(GLOB figure_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/figures/*.cpp)
add_library(aqc_figures ${figure_sources})
target_link_libraries(aqc_figures PUBLIC aqc_report)
aqc_batch(aqc_figures)

# Fault flights by the thousand.
file(GLOB campaign_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/campaign/*.cpp)
add_library(aqc_campaign ${campaign_sources})
target_include_directories(aqc_campaign PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
target_link_libraries(aqc_campaign PUBLIC aqc_core Threads::Threads)
aqc_batch(aqc_campaign)

foreach(program fly fault_flights vehicle_urdf)
  add_executable(${program} ${PROJECT_SOURCE_DIR}/src/apps/${program}.cpp)
  target_link_libraries(${program} aqc_figures CLI11::CLI11)
  install(TARGETS ${program} RUNTIME DESTINATION ${AQC_PROGRAM_DESTINATION})
endforeach()
target_link_libraries(fault_flights aqc_campaign)
install(TARGETS aqc_report aqc_figures aqc_campaign
  ARCHIVE DESTINATION ${AQC_LIB_DESTINATION}
  LIBRARY DESTINATION ${AQC_LIB_DESTINATION}
  RUNTIME DESTINATION ${AQC_BIN_DESTINATION})

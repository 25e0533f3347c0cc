# catkin: messages and where things go. src/ros/CMakeLists.txt has the nodes.

# Another python in the PATH would lack the ROS modules.
foreach(variable PYTHON_EXECUTABLE Python3_EXECUTABLE)
  if(NOT ${variable})
    set(${variable} /usr/bin/python3 CACHE FILEPATH "Python with the ROS modules")
  endif()
endforeach()

# What a vehicle needs. Tools and display look for more: parts.cmake.
find_package(catkin REQUIRED COMPONENTS
  diagnostic_updater dynamic_reconfigure geometry_msgs message_generation nav_msgs nodelet
  pluginlib roscpp rosgraph_msgs sensor_msgs std_msgs std_srvs tf2 tf2_geometry_msgs tf2_ros
  trajectory_msgs)

add_message_files(FILES ActiveSubsystem.msg Actuators.msg ControllerState.msg PathProgress.msg PlantStatus.msg)
add_service_files(FILES ApplyDisturbance.srv AttachPayload.srv DetachPayload.srv FlyPath.srv GoTo.srv
                        LoseCommands.srv SetBattery.srv SetBody.srv SetGust.srv SetRotor.srv SetWind.srv)
generate_messages(DEPENDENCIES geometry_msgs nav_msgs std_msgs)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES aqc_core
  CATKIN_DEPENDS geometry_msgs message_runtime nav_msgs std_msgs
  DEPENDS EIGEN3 YAML_CPP)

set(AQC_TESTS ${CATKIN_ENABLE_TESTING})
set(AQC_LIB_DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
set(AQC_BIN_DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
set(AQC_PROGRAM_DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
set(AQC_INCLUDE_DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION})
set(AQC_SHARE_DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

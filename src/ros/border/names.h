#pragma once

// What more than one file of the nodes calls by its name.

namespace aqc {

constexpr const char* kWorldFrame = "world";     ///< W
constexpr const char* kBodyFrame = "base_link";  ///< B

// Topics, relative to the vehicle's namespace.
constexpr const char* kTrajectoryTopic = "command/trajectory";
constexpr const char* kPoseTopic = "command/pose";
constexpr const char* kMotorSpeedTopic = "command/motor_speed";
constexpr const char* kStateTopic = "controller/state";
constexpr const char* kStatusTopic = "plant/status";
constexpr const char* kOdometryTopic = "odometry";
constexpr const char* kImuTopic = "imu";
constexpr const char* kSubsystemTopic = "active_subsystem";

/// The node plant_node and, below it, its services.
constexpr const char* kPlantServices = "plant/";
constexpr const char* kControllerServices = "controller/";

}  // namespace aqc

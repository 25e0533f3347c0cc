#include "ros/controller/imu_input.h"

#include <cmath>
#include <utility>

namespace aqc {
namespace {

constexpr double kWarningPeriod = 1.0;  // [s]

}  // namespace

ImuInput::ImuInput(ros::NodeHandle& node, std::function<void()> arrived)
    : arrived_(std::move(arrived)),
      subscriber_(
          node.subscribe("imu", 10, &ImuInput::onImu, this, ros::TransportHints().tcpNoDelay())) {}

void ImuInput::onImu(const sensor_msgs::Imu::ConstPtr& message) {
  const Nanoseconds time = toNanoseconds(message->header.stamp);
  if (monitor_.take(toEigen(message->linear_acceleration), time)) return arrived_();
  ROS_WARN_THROTTLE(kWarningPeriod,
                    "imu sample dropped: it is not finite or its stamp goes back (%ld so far)",
                    monitor_.dropped());
}

void ImuInput::feed(FlightController& controller, Nanoseconds odometry) {
  const bool was_usable = monitor_.usable();
  if (const Eigen::Vector3d* specific_force = monitor_.at(odometry)) {
    controller.senseSpecificForce(*specific_force);
  } else {
    controller.forgetSpecificForce();
  }
  if (was_usable == monitor_.usable()) return;
  const std::string topic = subscriber_.getTopic();
  if (was_usable) {
    ROS_WARN(
        "the last sample of '%s' is %.3f s away from the odometry: the acceleration comes from the "
        "velocity until it is back",
        topic.c_str(), std::abs(toSeconds(odometry - monitor_.time())));
  } else {
    ROS_INFO("'%s' is there", topic.c_str());
  }
}

void ImuInput::fill(msgs::ControllerState& state) const {
  state.imu_lost = !monitor_.usable();
  state.imu_losses = static_cast<std::uint32_t>(monitor_.losses());
  state.dropped_imu = static_cast<std::uint32_t>(monitor_.dropped());
}

}  // namespace aqc

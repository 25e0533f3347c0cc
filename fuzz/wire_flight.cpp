#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>
#include <sensor_msgs/Imu.h>

#include <optional>
#include <stdexcept>

#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "fuzz/range.h"
#include "fuzz/shipped.h"
#include "fuzz/targets.h"
#include "ros/border/bounded_message.h"
#include "ros/border/conversions.h"

namespace aqc::fuzz {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;
constexpr int kPeriodsAfter = 10;

// As roscpp reads it: what it throws means that the message never came.
template <typename Message>
std::optional<Message> read(std::string bytes) {
  try {
    Message message;
    ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                       static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::deserialize(stream, message);
    return message;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

// A guarded pilot that hears of a hover.
class WireFlight {
 public:
  WireFlight()
      : vehicle_(shippedVehicle("pelican_thesis")),
        pilot_(vehicle_, shippedLaw("asmc", "pelican_thesis"), kPeriod, StepClock::Trigger::kTimer,
               limits()) {
    state_.position.z() = 2.0;
    pilot_.guard()->wasArmed();
    for (int i = 0; i < kPeriodsAfter; ++i) advance();
  }

  // What ControllerNodelet makes of a message.
  void hear(unsigned kind, const std::string& bytes) {
    if (kind % 4 == 0) {
      const auto heard = read<nav_msgs::Odometry>(bytes);
      if (heard) pilot_.hear(toState(*heard), toNanoseconds(heard->header.stamp), now_);
    } else if (kind % 4 == 1) {
      const auto heard = read<sensor_msgs::Imu>(bytes);
      if (!heard) return;
      pilot_.hear(toEigen(heard->linear_acceleration), toEigen(heard->angular_velocity),
                  toNanoseconds(heard->header.stamp));
    } else if (kind % 4 == 2) {
      const auto heard = read<geometry_msgs::PoseStamped>(bytes);
      if (!heard) return;
      plan(heard->header.stamp, [&](Nanoseconds) {
        return std::vector<TimedSetPoint>{{now_, toSetPoint(heard->pose)}};
      });
    } else {
      const auto heard = read<BoundedTrajectory>(bytes);
      if (!heard || !heard->refusal.empty()) return;
      plan(heard->trajectory.header.stamp,
           [&](Nanoseconds begin) { return toSetPoints(heard->trajectory, begin); });
    }
  }
  std::string finding() {
    for (int i = 0; i < kPeriodsAfter; ++i) {
      advance();
      std::string range = outOfRange(pilot_.allocation().speeds, vehicle_);
      if (!range.empty()) return range;
      if (!pilot_.law().finite()) return "a guarded law is not finite";
    }
    return "";
  }

 private:
  static PilotLimits limits() {
    PilotLimits limits;
    limits.guard = GuardLimits();
    return limits;
  }
  void advance() {
    pilot_.tick(now_);
    now_ += kPeriod;
    pilot_.hear(state_, now_, now_);
  }
  template <typename ToSetPoints>
  void plan(const ros::Time& stamp, const ToSetPoints& to_set_points) {
    try {
      const Nanoseconds said = toNanoseconds(stamp);
      pilot_.plan(to_set_points(pilot_.beginning(said, now_)), now_, said);
    } catch (const std::invalid_argument&) {
      pilot_.countRefusedSetPoints();
    }
  }

  Vehicle vehicle_;
  Pilot pilot_;
  State state_;
  Nanoseconds now_ = 1'000'000'000'000;
};

}  // namespace

std::string hearWire(const std::string& bytes) {
  if (bytes.empty()) return "";
  WireFlight flight;
  flight.hear(static_cast<unsigned char>(bytes.front()), bytes.substr(1));
  return flight.finding();
}

}  // namespace aqc::fuzz

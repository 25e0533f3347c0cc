#include "ros/controller/pilot_inputs.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/model/frame_change.h"

namespace aqc {
namespace {

constexpr double kWarningPeriod = 1.0;  // [s], at most one warning of a kind in this time

}  // namespace

PilotInputs::PilotInputs(const ros::NodeHandle& node, Pilot& pilot, const Frames::Names& frames,
                         Nanoseconds source_patience, Reactions reactions)
    : node_(node),
      pilot_(pilot),
      reactions_(std::move(reactions)),
      odometry_source_(source_patience) {
  if (pilot_.guard() != nullptr) frames_ = std::make_unique<Frames>(frames);
  const auto fast = ros::TransportHints().tcpNoDelay();
  ros::SubscribeOptions odometry;
  odometry.initByFullCallbackType<const OdometryEvent&>(
      kOdometryTopic, 10, [this](const OdometryEvent& event) { onOdometry(event); });
  odometry.transport_hints = fast;
  odometry_subscriber_ = node_.subscribe(odometry);
  trajectory_subscriber_ =
      node_.subscribe(kTrajectoryTopic, 10, &PilotInputs::onTrajectory, this, fast);
  pose_subscriber_ = node_.subscribe(kPoseTopic, 10, &PilotInputs::onPose, this, fast);
  followLaw();
}

void PilotInputs::followLaw() {
  const auto fast = ros::TransportHints().tcpNoDelay();
  const SubsystemSwitch* subsystems = pilot_.law().subsystems();
  if (subsystems == nullptr) {
    order_subscriber_.shutdown();
  } else if (!order_subscriber_) {
    ROS_INFO("%d subsystems, %d active; %s", subsystems->count(), subsystems->active(),
             subsystems->text().c_str());
    order_subscriber_ =
        node_.subscribe(kSubsystemTopic, SwitchSchedule::kMost, &PilotInputs::onOrder, this, fast);
  }
  if (!pilot_.law().usesSpecificForce() && pilot_.guard() == nullptr) {
    imu_subscriber_.shutdown();
  } else if (!imu_subscriber_) {
    imu_subscriber_ = node_.subscribe(kImuTopic, 10, &PilotInputs::onImu, this, fast);
  }
}

// False, and it is counted, when tf2 does not know the frames of the message.
bool PilotInputs::toOwnFrames(const nav_msgs::Odometry& message, State& state) {
  const std::string& world = message.header.frame_id;
  const std::string& body = message.child_frame_id;
  if (!frames_ || (frames_->isWorld(world) && frames_->isBody(body))) return true;
  const auto f_in_w = frames_->toWorld(world);
  const auto b_in_c = f_in_w ? frames_->bodyIn(body) : std::nullopt;
  if (!b_in_c) {
    refuseOdometry(frames_->why());
    return false;
  }
  if (state.valid()) state = changeFrames(state, *f_in_w, *b_in_c);
  return true;
}

void PilotInputs::refuseOdometry(const std::string& why) {
  pilot_.countRefusedOdometry();
  ROS_WARN_THROTTLE(kWarningPeriod, "odometry dropped: %s (%u so far)", why.c_str(),
                    pilot_.droppedOdometry());
}

void PilotInputs::onOdometry(const OdometryEvent& event) {
  const nav_msgs::Odometry& message = *event.getConstMessage();
  if (frames_ && !odometry_source_.hears(event.getPublisherName(), steadyNow())) {
    refuseOdometry("'" + event.getPublisherName() + "' publishes it beside '" +
                   odometry_source_.name() + "', which is heard");
    return;
  }
  State state = toState(message);
  if (!toOwnFrames(message, state)) return;
  const Answer answer =
      pilot_.hear(state, toNanoseconds(message.header.stamp), toNanoseconds(ros::Time::now()));
  if (answer.began_anew) {
    ROS_WARN_THROTTLE(kWarningPeriod,
                      "odometry went back so far that its clock was started anew: plans of the old "
                      "time are gone");
  }
  if (answer.refusal != nullptr) {
    ROS_WARN_THROTTLE(kWarningPeriod, "odometry dropped: %s (%u so far)", answer.refusal,
                      pilot_.droppedOdometry());
  } else {
    reactions_.odometry_was_heard();
  }
  reactions_.act(answer.publish);
}

void PilotInputs::onImu(const sensor_msgs::Imu::ConstPtr& message) {
  const Eigen::Vector3d force = toEigen(message->linear_acceleration);
  const Nanoseconds stamp = toNanoseconds(message->header.stamp);
  // So sensor_msgs/Imu says that there is none.
  const bool gyroscope = message->angular_velocity_covariance[0] != -1.0;
  const Answer answer = gyroscope ? pilot_.hear(force, toEigen(message->angular_velocity), stamp)
                                  : pilot_.hear(force, stamp);
  if (answer.refusal != nullptr) {
    ROS_WARN_THROTTLE(kWarningPeriod, "imu sample dropped: %s (%ld so far)", answer.refusal,
                      pilot_.imu().dropped());
  }
  reactions_.act(answer.publish);
}

// Throws std::invalid_argument when tf2 does not know the frame.
Eigen::Isometry3d PilotInputs::toWorld(const std::string& frame) {
  if (!frames_) return Eigen::Isometry3d::Identity();
  const auto transform = frames_->toWorld(frame);
  if (!transform) throw std::invalid_argument(frames_->why());
  return *transform;
}

template <class ToSetPoints>
void PilotInputs::plan(const char* what, const ros::Time& stamp, ToSetPoints to_set_points) {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  try {
    pilot_.plan(to_set_points(now), now, toNanoseconds(stamp));
  } catch (const std::invalid_argument& error) {
    pilot_.countRefusedSetPoints();
    ROS_WARN_THROTTLE(kWarningPeriod, "%s dropped: %s (%u so far)", what, error.what(),
                      pilot_.droppedSetPoints());
  }
}

void PilotInputs::onTrajectory(const BoundedTrajectory::ConstPtr& message) {
  const std_msgs::Header& header = message->trajectory.header;
  plan("trajectory", header.stamp, [&](Nanoseconds now) {
    if (!message->refusal.empty()) throw std::invalid_argument(message->refusal);
    return toSetPoints(message->trajectory, pilot_.beginning(toNanoseconds(header.stamp), now),
                       toWorld(header.frame_id));
  });
}

void PilotInputs::onPose(const geometry_msgs::PoseStamped::ConstPtr& message) {
  plan("pose", message->header.stamp, [&](Nanoseconds now) {
    const Eigen::Isometry3d to_world = toWorld(message->header.frame_id);
    return std::vector<TimedSetPoint>{{now, toSetPoint(message->pose, "the pose", to_world)}};
  });
}

void PilotInputs::onOrder(const msgs::ActiveSubsystem::ConstPtr& message) {
  if (pilot_.order({toNanoseconds(message->header.stamp), message->subsystem})) return;
  ROS_WARN_THROTTLE(kWarningPeriod, "switch dropped: %zu wait already", pilot_.switchesPending());
}

}  // namespace aqc

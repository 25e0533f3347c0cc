#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <memory>
#include <optional>
#include <stdexcept>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/pilot/step_clock.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"
#include "ros/controller/flight_diagnostics.h"
#include "ros/controller/gain_tuner.h"
#include "ros/controller/imu_input.h"
#include "ros/controller/switch_input.h"

namespace aqc {

/// The control law in ROS: a thin shell around FlightController and the StepClock that drives it.
///
/// In: `odometry`, `command/trajectory`, `command/pose`; `imu` and `active_subsystem` for laws that
/// need them. Out: `command/motor_speed`, `~state`.
/// Parameters: `vehicle` (see config/vehicle), `~gains` (see config/controller), `~rate` [Hz]
/// (default: `scenario/control_rate` where a scenario is loaded, else 250), `~trigger`. All
/// callbacks come from one queue in one thread, so nothing is locked. Gains and law may change in
/// flight: see GainTuner and HandoverLimits.
///
/// `~trigger: timer` runs the law at `~rate` by ROS time on the latest odometry; `odometry` runs
/// it when odometry that is due arrives and answers every odometry, which a lock-stepped
/// simulation needs; a law that needs the IMU then waits for its sample of the same stamp, unless
/// it has fallen silent or odometry comes again first. Before the first good odometry and the first
/// set point only zero speeds are published.
///
/// Odometry whose stamp goes back is dropped. StepClock::kConfirming in a row that go back by more
/// than kNewStart mean that the clock was started anew, and so is the control: the law forgets what
/// it learned, set points and switches of the old time are gone, and the rotors stand still until a
/// new set point comes. One that came before the first odometry of the new time is of the old one.
class ControllerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void configure();
  void connect();
  void connectLaw();

  void onOdometry(const nav_msgs::Odometry::ConstPtr& message);
  void onTrajectory(const trajectory_msgs::MultiDOFJointTrajectory::ConstPtr& message);
  void onPose(const geometry_msgs::PoseStamped::ConstPtr& message);
  void onTimer(const ros::TimerEvent& event);

  void accept(std::vector<TimedSetPoint> set_points, Nanoseconds now, const ros::Time& stamp);
  void startAnew();
  void dropOdometry(const char* reason);
  void dropSetPoint(const char* what, const std::invalid_argument& error);
  void step(Nanoseconds now);
  std::string swapLaw(PreparedLaw& prepared);
  void publishMotors();
  void publishState();

  std::unique_ptr<FlightController> controller_;
  SetPointSchedule schedule_;
  std::string law_name_;
  std::vector<std::string> adaptive_names_;

  std::optional<StepClock> clock_;  // set by configure()
  std::optional<State> state_;      // of the last good odometry
  SetPoint set_point_;              // of the last step that had one
  ros::Time trajectory_stamp_;
  std::uint32_t dropped_odometry_ = 0;
  std::uint32_t dropped_set_points_ = 0;

  ros::Subscriber odometry_subscriber_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber pose_subscriber_;
  ros::Publisher motor_publisher_;
  ros::Publisher state_publisher_;
  ros::Timer timer_;
  std::unique_ptr<ImuInput> imu_;        // null: the law needs none
  std::unique_ptr<SwitchInput> switch_;  // null: the law has no subsystems
  std::unique_ptr<FlightDiagnostics> diagnostics_;
  std::unique_ptr<GainTuner> tuner_;
};

}  // namespace aqc

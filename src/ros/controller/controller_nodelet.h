#pragma once

#include <nodelet/nodelet.h>
#include <ros/ros.h>

#include <memory>
#include <optional>
#include <string>

#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "ros/controller/armed_record.h"
#include "ros/controller/flight_diagnostics.h"
#include "ros/controller/gain_tuner.h"
#include "ros/controller/guard_services.h"
#include "ros/controller/pilot_inputs.h"
#include "ros/controller/pilot_outputs.h"

namespace aqc {

/// A Pilot in ROS: messages go in (PilotInputs), rotor speeds come out (PilotOutputs). With a guard
/// (the default; `~guarded: false` flies without) also its services: see GuardServices.
///
/// Parameters: `vehicle` (see config/vehicle), `~gains` (see config/controller), `~rate` [Hz]
/// (default 250), `~trigger`, `~limits` (see PilotLimits; default: none), `~guard` (see
/// GuardLimits), `~world_frame` and `~body_frame` (default `world`, `base_link`). All callbacks
/// come from one queue in one thread, so nothing is locked. Gains and law may change in flight: see
/// GainTuner and HandoverLimits. It does not start when another node commands the same rotors.
///
/// `~trigger: timer` runs the law at `~rate` by ROS time on the latest odometry; `odometry` runs
/// it when odometry that is due arrives and answers every odometry, which a lock-stepped
/// simulation needs; a law that uses the IMU then waits for its sample of the same stamp, unless
/// it has fallen silent or odometry comes again first. Before the first good odometry and the first
/// set point only zero speeds are published. A set point that came before the first odometry of a
/// clock that was started anew is of the old time.
class ControllerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void configure();
  void connectGuard();
  void startTimer();
  void onTimer();
  void act(Publish publish);
  std::string swapLaw(PreparedLaw& prepared);

  std::unique_ptr<Pilot> pilot_;
  std::optional<PilotOutputs> outputs_;
  std::unique_ptr<PilotInputs> inputs_;
  std::unique_ptr<FlightDiagnostics> diagnostics_;
  std::unique_ptr<GainTuner> tuner_;
  std::unique_ptr<ArmedRecord> armed_record_;
  std::unique_ptr<GuardServices> guard_services_;
  ros::Timer timer_;               // of a simulated clock
  ros::SteadyTimer steady_timer_;  // of a real one, which may step
};

}  // namespace aqc

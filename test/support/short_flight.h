#pragma once

#include <cmath>
#include <string>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

/// A flight that is short enough to know all its figures by heart.
namespace aqc::test {

/// Ten seconds at 10 Hz; the errors count from 4 s on.
inline Scenario scenario() {
  Scenario scenario;
  scenario.name = "short";
  scenario.title = "A short flight";
  scenario.duration = fromSeconds(10.0);
  scenario.world.control_period = fromSeconds(0.1);
  scenario.metrics_from = fromSeconds(4.0);
  AttachPayload attach;
  attach.payload.mass = 0.5;
  scenario.mission.events.push_back({fromSeconds(4.0), attach});
  scenario.published["good"].position = {0.2, 0.2, 0.0};
  scenario.published["good"].attitude = {4.0, 4.0, 4.0};
  return scenario;
}

inline Vehicle vehicle() {
  Vehicle vehicle;
  vehicle.name = "test bird";
  vehicle.mass = 2.0;
  vehicle.rotors.resize(4);
  vehicle.max_rotor_speed = 900.0;
  return vehicle;
}

/// Flies from 1 s on with constant errors: 0.1, 0.2 and -0.3 m; 2, 2 and 2 deg.
inline FlightLog log(const std::string& controller) {
  FlightLog log;
  log.controller = controller;
  log.adaptive_quantities = {{"K_a", "N"}, {"K_b", "N m/\u2016\u03be\u2016\u00b2"}};
  for (int i = 0; i < 100; ++i) {
    FlightSample sample;
    sample.time = fromSeconds(0.1 * i);
    sample.flying = i >= 10;
    sample.state.position = {1.0 / 3.0, 0.01 * i, 1.0};
    sample.telemetry.position_error = {0.1, 0.2, -0.3};
    sample.telemetry.attitude_error.setConstant(2.0 * M_PI / 180.0);
    sample.telemetry.adaptive = Eigen::Vector2d(0.25, 0.01 * i);
    sample.allocation.speeds = Eigen::Vector4d::Constant(700.0);
    sample.payload_mass = i >= 40 ? 0.5 : 0.0;
    log.samples.push_back(sample);
  }
  return log;
}

inline FlightLog crashed(const std::string& controller) {
  FlightLog flight = log(controller);
  flight.crash_time = fromSeconds(6.5);
  flight.crash_reason = "hard impact";
  flight.refusals = {{fromSeconds(4.0), "the box is out of reach"}};
  return flight;
}

}  // namespace aqc::test

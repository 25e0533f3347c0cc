#include "recorded_flight.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include <filesystem>
#include <iterator>
#include <map>
#include <stdexcept>

#include "adaptive_quadrotor_control/PlantStatus.h"
#include "adaptive_quadrotor_control/ros/conversions.h"

namespace aqc {
namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Collects the messages of a bag; they come by time of arrival.
class Reader {
 public:
  void add(const rosbag::MessageInstance& message) {
    const std::string& topic = message.getTopic();
    if (endsWith(topic, "controller/state")) {
      if (const auto state = message.instantiate<msgs::ControllerState>()) addState(*state);
    } else if (endsWith(topic, "plant/status")) {
      const auto status = message.instantiate<msgs::PlantStatus>();
      if (status) truth_[toNanoseconds(status->header.stamp)] = status;
    } else if (endsWith(topic, "controller/parameters")) {
      if (const auto text = message.instantiate<std_msgs::String>()) parameters_ = text->data;
    }
  }

  RecordedFlight take(const std::string& path) {
    RecordedFlight flight;
    if (samples_.empty()) throw std::runtime_error("'" + path + "' holds no flight");
    if (parameters_.empty()) {
      throw std::runtime_error("'" + path +
                               "' lacks controller/parameters, which tell the vehicle");
    }
    flight.vehicle = readVehicle(ParameterReader(YAML::Load(parameters_)["vehicle"], "vehicle"));
    flight.log = std::move(log_);
    flight.log.samples = std::move(samples_);
    addTruth(flight.log);
    const Nanoseconds begin = flight.log.samples.front().time;
    for (FlightSample& sample : flight.log.samples) sample.time -= begin;
    if (flight.log.crash_time) *flight.log.crash_time -= begin;
    flight.log.controller = std::filesystem::path(path).stem().string();
    flight.scenario = scenarioOf(flight.log);
    return flight;
  }

 private:
  void addState(const msgs::ControllerState& state) {
    const Nanoseconds time = toNanoseconds(state.header.stamp);
    if (samples_.empty() && !state.flying) return;
    if (!samples_.empty() && time <= samples_.back().time) return;
    // Figures have one set of names: that of the law at the start.
    if (samples_.empty()) log_.adaptive_names = state.adaptive_names;
    samples_.push_back(toSample(state));
    if (state.adaptive_names != log_.adaptive_names) samples_.back().telemetry.adaptive.resize(0);
  }

  void addTruth(FlightLog& log) const {
    for (FlightSample& sample : log.samples) {
      const auto later = truth_.upper_bound(sample.time);
      if (later == truth_.begin()) continue;
      const msgs::PlantStatus& truth = *std::prev(later)->second;
      sample.payload_mass = truth.payload_mass;
      sample.touching = truth.touching;
      if (!truth.crashed || log.crash_time) continue;
      log.crash_time = toNanoseconds(truth.crash_time);
      log.crash_reason = truth.crash_reason;
    }
  }

  // The payload changes as they happened, not as they were planned.
  static Scenario scenarioOf(const FlightLog& log) {
    Scenario scenario;
    scenario.name = scenario.title = log.controller;
    scenario.duration = log.samples.back().time;
    double mass = 0.0;
    for (const FlightSample& sample : log.samples) {
      if (sample.payload_mass == mass) continue;
      if (mass > 0.0) scenario.events.push_back({sample.time, DetachPayload{}});
      mass = sample.payload_mass;
      if (mass == 0.0) continue;
      AttachPayload attach;
      attach.payload.mass = mass;
      scenario.events.push_back({sample.time, attach});
    }
    return scenario;
  }

  FlightLog log_;
  std::vector<FlightSample> samples_;
  std::map<Nanoseconds, msgs::PlantStatus::ConstPtr> truth_;
  std::string parameters_;
};

}  // namespace

RecordedFlight readBag(const std::string& path) {
  try {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    Reader reader;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) reader.add(message);
    return reader.take(path);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error("cannot read '" + path + "': " + error.what());
  }
}

}  // namespace aqc

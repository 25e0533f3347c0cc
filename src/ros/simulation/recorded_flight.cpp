#include "ros/simulation/recorded_flight.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "ros/border/conversions.h"
#include "ros/border/names.h"

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
    if (endsWith(topic, kStateTopic)) {
      if (const auto state = message.instantiate<msgs::ControllerState>()) addState(*state);
    } else if (endsWith(topic, kStatusTopic)) {
      const auto status = message.instantiate<msgs::PlantStatus>();
      if (status) truth_[toNanoseconds(status->header.stamp)] = status;
    } else if (endsWith(topic, "controller/parameters")) {
      if (const auto text = message.instantiate<std_msgs::String>()) parameters_ = text->data;
    }
  }

  Recording take(const std::string& path) {
    Recording recording;
    recording.path = path;
    if (!begin_) throw std::runtime_error("'" + path + "' holds no flight");
    if (parameters_.empty()) {
      throw std::runtime_error("'" + path +
                               "' lacks controller/parameters, which tell the vehicle");
    }
    recording.vehicle = readVehicle(ParameterReader(YAML::Load(parameters_)["vehicle"], "vehicle"));
    addTruth();
    for (FlightSample& sample : log_.samples) sample.time -= *begin_;
    if (log_.crash_time) *log_.crash_time -= *begin_;
    recording.log = std::move(log_);
    recording.backdrop = backdropOf(recording.log, std::filesystem::path(path).stem().string());
    return recording;
  }

 private:
  void addState(const msgs::ControllerState& state) {
    const Nanoseconds time = toNanoseconds(state.header.stamp);
    if (!begin_ && state.flying) begin(time, toNanoseconds(state.trajectory_stamp), state);
    if (!log_.samples.empty() && time <= log_.samples.back().time) return;
    log_.samples.push_back(toSample(state));
    if (begin_ && toQuantities(state) != log_.adaptive_quantities) {
      log_.samples.back().telemetry.adaptive.resize(0);
    }
  }

  // The first step that flies. Set points that were sent before with a stamp that the recording
  // holds are a mission, whose time begins there.
  void begin(Nanoseconds time, Nanoseconds sent, const msgs::ControllerState& state) {
    auto& samples = log_.samples;
    const bool mission = !samples.empty() && sent >= samples.front().time && sent <= time;
    begin_ = mission ? sent : time;
    const auto before = [this](const FlightSample& sample) { return sample.time < *begin_; };
    samples.erase(std::remove_if(samples.begin(), samples.end(), before), samples.end());
    // Figures have one set of names and units: that of the law at the start.
    log_.controller = state.controller;
    log_.adaptive_quantities = toQuantities(state);
  }

  void addTruth() {
    for (FlightSample& sample : log_.samples) {
      const msgs::PlantStatus* truth = aqc::addTruth(truth_, sample);
      if (truth == nullptr || !truth->crashed || log_.crash_time) continue;
      log_.crash_time = toNanoseconds(truth->crash_time);
      log_.crash_reason = truth->crash_reason;
    }
  }

  FlightLog log_;
  std::optional<Nanoseconds> begin_;  // none until something flies
  PlantHistory truth_;
  std::string parameters_;
};

}  // namespace

Recording readBag(const std::string& path) {
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

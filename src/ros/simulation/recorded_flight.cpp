#include "ros/simulation/recorded_flight.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include <filesystem>
#include <stdexcept>

#include "adaptive_quadrotor_control/flight/collector.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
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
      const auto state = message.instantiate<msgs::ControllerState>();
      if (state) collector_.add(toReport(*state));
    } else if (endsWith(topic, kStatusTopic)) {
      const auto status = message.instantiate<msgs::PlantStatus>();
      if (status) collector_.add(toTruth(*status));
    } else if (endsWith(topic, "controller/parameters")) {
      if (const auto text = message.instantiate<std_msgs::String>()) parameters_ = text->data;
    }
  }

  Recording take(const std::string& path) {
    Recording recording;
    recording.path = path;
    if (!collector_.begin()) throw std::runtime_error("'" + path + "' holds no flight");
    if (parameters_.empty()) {
      throw std::runtime_error("'" + path +
                               "' lacks controller/parameters, which tell the vehicle");
    }
    recording.vehicle = readVehicle(ParameterReader(YAML::Load(parameters_)["vehicle"], "vehicle"));
    recording.log = collector_.take();
    recording.backdrop = backdropOf(recording.log, std::filesystem::path(path).stem().string());
    return recording;
  }

 private:
  Collector collector_;
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

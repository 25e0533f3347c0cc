#include "ros/controller/armed_record.h"

#include <chrono>

namespace aqc {

ArmedRecord::ArmedRecord(const ros::NodeHandle& private_node)
    : name_(private_node.resolveName("was_armed")) {
  ros::param::param(name_, was_armed_, false);
  armed_ = was_armed_;
  thread_ = std::thread(&ArmedRecord::keep, this);
}

ArmedRecord::~ArmedRecord() {
  over_ = true;
  thread_.join();
}

void ArmedRecord::keep() {
  bool written = was_armed_;
  while (!over_) {
    const bool armed = armed_;
    if (armed != written) {
      ros::param::set(name_, armed);
      written = armed;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace aqc

#include "adaptive_quadrotor_control/simulation/command_link.h"

#include <stdexcept>
#include <string>

namespace aqc {
namespace {

constexpr std::uint64_t kLinkStream = 101;  // apart from those of the sensors and of gusts

}  // namespace

CommandLink::CommandLink(Eigen::Index rotors, Nanoseconds timeout)
    : off_(RotorArray::Zero(rotors)), last_(off_), timeout_(timeout) {
  if (timeout < 0) {
    throw std::invalid_argument("the time-out of commands is " + std::to_string(timeout) +
                                " ns; it must be > 0, or 0 for none");
  }
}

void CommandLink::lose(double share, Nanoseconds until, std::uint64_t seed) {
  lost_share_ = share;
  lost_until_ = until;
  dice_ = Random(seed, kLinkStream);
}

void CommandLink::send(const RotorArray& command, Nanoseconds now) {
  if (now < lost_until_ && dice_.chance(lost_share_)) return;
  last_ = command;
  heard_ = now;
  heard_any_ = true;
}

}  // namespace aqc

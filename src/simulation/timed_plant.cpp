#include "adaptive_quadrotor_control/simulation/timed_plant.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace aqc {

TimedPlant::TimedPlant(Plant plant, Nanoseconds step, Nanoseconds start)
    : plant_(std::move(plant)), step_(step), now_(start) {
  if (step <= 0) throw std::invalid_argument("the plant's step must be > 0 ns");
}

void TimedPlant::schedule(const PlantEvent& event) {
  std::vector<PlantEvent> events = events_;
  const auto later = [](const PlantEvent& a, const PlantEvent& b) { return a.time < b.time; };
  events.insert(std::upper_bound(events.begin(), events.end(), event, later), event);

  bool attached = plant_.payload().has_value();
  for (const PlantEvent& planned : events) {
    const bool attach = std::holds_alternative<AttachPayload>(planned.action);
    if (!attach && !std::holds_alternative<DetachPayload>(planned.action)) continue;
    if (attach == attached) {
      throw std::logic_error(attached ? "a payload is attached already; detach it first"
                                      : "no payload is attached");
    }
    attached = attach;
  }
  events_ = std::move(events);
}

void TimedPlant::apply(const PlantAction& action) {
  if (const auto* attach = std::get_if<AttachPayload>(&action)) {
    plant_.attach(attach->payload);
  } else if (const auto* wind = std::get_if<SetWind>(&action)) {
    plant_.setWind(wind->velocity);
  } else {
    plant_.detach();
  }
}

void TimedPlant::advance(const RotorArray& command, Nanoseconds until) {
  const double dt = toSeconds(step_);
  while (now_ < until) {
    while (!events_.empty() && events_.front().time <= now_) {
      apply(events_.front().action);
      events_.erase(events_.begin());
    }
    plant_.step(command, dt);
    now_ += step_;
    if (!crash_time_ && plant_.crash() != Crash::kNone) crash_time_ = now_;
  }
}

}  // namespace aqc

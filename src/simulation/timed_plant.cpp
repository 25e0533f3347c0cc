#include "adaptive_quadrotor_control/simulation/timed_plant.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

std::unique_ptr<Plant> required(std::unique_ptr<Plant> plant) {
  if (!plant) throw std::invalid_argument("there is no plant");
  return plant;
}

}  // namespace

TimedPlant::TimedPlant(std::unique_ptr<Plant> plant, std::vector<Cargo> cargo, Nanoseconds step,
                       Nanoseconds start, Nanoseconds command_timeout)
    : plant_(required(std::move(plant))),
      cargo_(std::move(cargo)),
      link_(plant_->rotorSpeeds().size(), command_timeout),
      step_(step),
      now_(start),
      rotors_(static_cast<std::size_t>(plant_->rotorSpeeds().size())) {
  if (step <= 0) throw std::invalid_argument("the plant's step must be > 0 ns");
  if (toSeconds(step) > plant_->longestStep()) {
    throw std::invalid_argument("the plant's step is " + numberText(toSeconds(step)) +
                                " s; it must be <= " + numberText(plant_->longestStep()) +
                                " s for a vehicle of so little inertia to stand on the ground, "
                                "or the scenario without ground and walls");
  }
}

void TimedPlant::schedule(const PlantEvent& event) {
  std::vector<PlantEvent> events = events_;
  const auto later = [](const PlantEvent& a, const PlantEvent& b) { return a.time < b.time; };
  events.insert(std::upper_bound(events.begin(), events.end(), event, later), event);

  bool attached = plant_->payload().has_value();
  const auto follow = [&attached](bool attach) {
    if (attach == attached) {
      throw std::logic_error(attached ? "a payload is attached already; detach it first"
                                      : "no payload is attached");
    }
    attached = attach;
  };
  const Overloaded follow_payload{[&](const AttachPayload&) { follow(true); },
                                  [&](const DetachPayload&) { follow(false); },
                                  [](const SetWind&) {},
                                  [](const SetBody&) {},
                                  [](const ApplyDisturbance&) {},
                                  [this](const SetRotor& rotor) { requireRotor(rotor.number); },
                                  [](const SetBattery&) {},
                                  [](const SetGust&) {},
                                  [](const LoseCommands&) {}};
  for (const PlantEvent& planned : events) std::visit(follow_payload, planned.action);
  events_ = std::move(events);
}

void TimedPlant::requireRotor(int number) const {
  const auto count = static_cast<int>(plant_->rotorSpeeds().size());
  if (number >= 1 && number <= count) return;
  throw std::invalid_argument("rotor " + std::to_string(number) +
                              " is none of the vehicle's; it must be 1 to " +
                              std::to_string(count));
}

std::vector<Cargo>::const_iterator TimedPlant::find(const std::string& name) const {
  return std::find_if(cargo_.begin(), cargo_.end(), [&name](const Cargo& cargo) {
    return !name.empty() && cargo.name == name;  // a payload that appeared may have no name
  });
}

bool TimedPlant::knows(const std::string& name) const {
  return find(name) != cargo_.end() || (plant_->payload() && attached_name_ == name);
}

std::string TimedPlant::obstacle(const AttachPayload& attach) const {
  if (plant_->payload()) return "a payload is attached already";
  if (plant_->crash() != Crash::kNone) return "the vehicle has crashed";
  const auto cargo = find(attach.name);
  if (cargo == cargo_.end()) return "";
  const State& state = plant_->state();
  const Eigen::Vector3d place = state.position + state.attitude * cargo->payload.offset;
  const double distance = (place - cargo->position).norm();
  if (const auto* cable = std::get_if<Cable>(&cargo->payload.mount)) {
    if (distance <= cable->length) return "";
    return formatted("%.60s is %.2f m from the hook; its cable is %.2f m long", attach.name.c_str(),
                     distance, cable->length);
  }
  if (distance <= kReach) return "";
  return formatted("%.60s is %.2f m away; it can be picked up within %.2f m", attach.name.c_str(),
                   distance, kReach);
}

void TimedPlant::attach(const AttachPayload& attach) {
  const std::string reason = obstacle(attach);
  if (!reason.empty()) {
    refusals_.push_back({now_, reason});
    return;
  }
  const auto cargo = find(attach.name);
  if (cargo == cargo_.end()) {
    plant_->attach(attach.payload, Eigen::Vector3d::Zero());
  } else {
    plant_->pickUp(cargo->payload, {cargo->position, cargo->velocity});
    cargo_.erase(cargo);
  }
  attached_name_ = attach.name;
}

void TimedPlant::detach() {
  if (!plant_->payload()) {
    refusals_.push_back({now_, "no payload is attached"});
    return;
  }
  const Payload payload = *plant_->payload();
  const FreeMotion motion = plant_->detach();
  cargo_.push_back({attached_name_, payload, motion.position, motion.velocity});
  attached_name_.clear();
}

void TimedPlant::apply(const PlantEvent& event) {
  const Overloaded act{[this](const AttachPayload& payload) { attach(payload); },
                       [this](const DetachPayload&) { detach(); },
                       [this](const SetWind& wind) {
                         wind_ = wind.velocity;
                         plant_->setWind(this->wind());
                       },
                       [this](const SetBody& body) { plant_->setBody(body.mass, body.inertia); },
                       [&](const ApplyDisturbance& shape) {
                         disturbances_.push_back({event.time, shape});
                       },
                       [this](const SetRotor& rotor) {
                         const auto index = static_cast<std::size_t>(rotor.number - 1);
                         rotors_[index] = rotor.condition;
                         plant_->setRotor(index, rotor.condition);
                       },
                       [&](const SetBattery& battery) {
                         drain_ = Drain{event.time, battery_, battery};
                       },
                       [this](const SetGust& gust) { setGust(gust); },
                       [&](const LoseCommands& loss) {
                         link_.lose(loss.share, event.time + loss.duration, loss.seed);
                       }};
  std::visit(act, event.action);
}

ForceMoment TimedPlant::disturbance() const noexcept {
  ForceMoment sum;
  for (const ActiveDisturbance& active : disturbances_) {
    const Nanoseconds age = now_ - active.begin;
    if (age >= active.shape.duration) continue;
    const double frequency = active.shape.angular_frequency;
    const double share = frequency > 0.0 ? std::sin(frequency * toSeconds(age)) : 1.0;
    sum.force += share * active.shape.amplitude.force;
    sum.moment += share * active.shape.amplitude.moment;
  }
  return sum;
}

void TimedPlant::disturb() {
  if (disturbances_.empty()) return;
  const auto over = [this](const ActiveDisturbance& active) {
    return now_ - active.begin >= active.shape.duration;
  };
  disturbances_.erase(std::remove_if(disturbances_.begin(), disturbances_.end(), over),
                      disturbances_.end());
  plant_->setDisturbance(disturbance());
}

void TimedPlant::setGust(const SetGust& shape) {
  gust_.reset();
  if (!shape.intensity.isZero(0.0)) gust_.emplace(shape, step_);
  plant_->setWind(wind());
}

Eigen::Vector3d TimedPlant::wind() const noexcept {
  return gust_ ? wind_ + gust_->velocity() : wind_;
}

void TimedPlant::drain() {
  if (!drain_) return;
  const auto& [begin, from, end] = *drain_;
  const Nanoseconds age = now_ - begin;
  if (age < end.over) {
    battery_ = from + (end.voltage - from) * (toSeconds(age) / toSeconds(end.over));
  } else {
    battery_ = end.voltage;
    drain_.reset();
  }
  plant_->setSpeedLimit(battery_);
}

void TimedPlant::happen() {
  while (!events_.empty() && events_.front().time <= now_) {
    apply(events_.front());
    events_.erase(events_.begin());
  }
}

void TimedPlant::command(const RotorArray& speeds) {
  happen();  // a loss that begins now concerns this command
  link_.send(speeds, now_);
}

void TimedPlant::advance(const RotorArray& command, Nanoseconds until) {
  if (now_ < until) this->command(command);
  advance(until);
}

void TimedPlant::advance(Nanoseconds until) {
  const double dt = toSeconds(step_);
  while (now_ < until) {
    happen();
    disturb();
    drain();
    plant_->step(link_.told(now_), dt);
    if (gust_) {
      gust_->advance();
      plant_->setWind(wind());
    }
    for (Cargo& cargo : cargo_) cargo.fall(dt, plant_->hasGround());
    now_ += step_;
    if (!crash_time_ && plant_->crash() != Crash::kNone) crash_time_ = now_;
  }
}

}  // namespace aqc

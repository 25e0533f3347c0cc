#include "adaptive_quadrotor_control/pilot/flight_controller.h"

#include <utility>

namespace aqc {
namespace {

constexpr double kMoment = 1e-3;  // [s]: for a law that has not seen the rotors turn yet

}  // namespace

FlightController::FlightController(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law)
    : rotors_(vehicle),
      lag_(vehicle),
      most_speed_(vehicle.max_rotor_speed),
      law_(std::move(law)),
      allocation_(rotors_.allocate({})) {}

void FlightController::turnRotors(double dt) noexcept {
  lag_.turn(allocation_.speeds, dt);
  if (law_->observesRotors()) law_->observe(given(), dt);
}

const Allocation& FlightController::step(const Sensed& sensed, const SetPoint* set_point, double dt,
                                         bool learn) noexcept {
  flying_ = set_point != nullptr;
  rotors_.allocate(flying_ ? law_->command(sensed, *set_point, dt) : Wrench(), allocation_);
  const double lead = law_->rotorLead();
  if (flying_ && lead > 1.0) lag_.lead(allocation_.speeds, lead, most_speed_, dt);
  turnRotors(dt);
  if (flying_ && learn) {
    law_->adapt({allocation_, lag_.speeds()}, dt);
  } else if (!flying_) {
    law_->reset();
  }
  return allocation_;
}

void FlightController::idle(double speed, double dt) noexcept {
  flying_ = false;
  rotors_.allocate(Wrench(), allocation_);
  allocation_.speeds.setConstant(speed);
  allocation_.achieved = rotors_.wrench(allocation_.speeds);
  turnRotors(dt);
  law_->reset();
}

void FlightController::bound(const EstimateBounds& bounds) noexcept {
  bounds_ = bounds;
  law_->bound(bounds);
}

std::unique_ptr<ControlLaw> FlightController::replaceLaw(std::unique_ptr<ControlLaw> law) noexcept {
  law->bound(bounds_);
  if (law->observesRotors()) law->observe(given(), kMoment);
  law->adopt(*law_);
  if (!flying_) law->reset();
  law_.swap(law);
  return law;
}

}  // namespace aqc

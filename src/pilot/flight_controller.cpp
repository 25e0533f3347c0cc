#include "adaptive_quadrotor_control/pilot/flight_controller.h"

#include <utility>

namespace aqc {

FlightController::FlightController(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law)
    : rotors_(vehicle), lag_(vehicle), law_(std::move(law)), allocation_(rotors_.allocate({})) {}

const Allocation& FlightController::step(const Sensed& sensed, const SetPoint* set_point, double dt,
                                         bool learn) noexcept {
  flying_ = set_point != nullptr;
  rotors_.allocate(flying_ ? law_->command(sensed, *set_point, dt) : Wrench(), allocation_);
  lag_.turn(allocation_.speeds, dt);
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
  lag_.turn(allocation_.speeds, dt);
  law_->reset();
}

void FlightController::bound(const EstimateBounds& bounds) noexcept {
  bounds_ = bounds;
  law_->bound(bounds);
}

std::unique_ptr<ControlLaw> FlightController::replaceLaw(std::unique_ptr<ControlLaw> law) noexcept {
  law->bound(bounds_);
  law->adopt(*law_);
  if (!flying_) law->reset();
  law_.swap(law);
  return law;
}

}  // namespace aqc

#include "adaptive_quadrotor_control/pilot/flight_controller.h"

#include <utility>

namespace aqc {

FlightController::FlightController(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law)
    : rotors_(vehicle), lag_(vehicle), law_(std::move(law)), allocation_(rotors_.allocate({})) {}

const Allocation& FlightController::step(const Sensed& sensed, const SetPoint* set_point,
                                         double dt) noexcept {
  flying_ = set_point != nullptr;
  rotors_.allocate(flying_ ? law_->command(sensed, *set_point, dt) : Wrench(), allocation_);
  lag_.turn(allocation_.speeds, dt);
  if (flying_) {
    law_->adapt({allocation_, lag_.speeds()}, dt);
  } else {
    law_->reset();
  }
  return allocation_;
}

std::unique_ptr<ControlLaw> FlightController::replaceLaw(std::unique_ptr<ControlLaw> law) noexcept {
  law->adopt(*law_);
  if (!flying_) law->reset();
  law_.swap(law);
  return law;
}

}  // namespace aqc

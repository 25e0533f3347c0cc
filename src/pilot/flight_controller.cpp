#include "adaptive_quadrotor_control/pilot/flight_controller.h"

#include <utility>

namespace aqc {

FlightController::FlightController(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law)
    : rotors_(vehicle), law_(std::move(law)), allocation_(rotors_.allocate({})) {}

const Allocation& FlightController::step(const State& state, const SetPoint* set_point,
                                         double dt) noexcept {
  flying_ = set_point != nullptr;
  if (flying_) {
    allocation_ = rotors_.allocate(law_->update(state, *set_point, dt));
  } else {
    law_->reset();
    allocation_ = rotors_.allocate({});
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

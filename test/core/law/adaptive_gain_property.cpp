#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "adaptive_quadrotor_control/law/adaptive_gain.h"

namespace aqc {
namespace {

double anyReal(double low, double high) {
  constexpr int kSteps = 1000000;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

double anyMagnitude(double low, double high) {
  return std::pow(10.0, anyReal(low, high));
}

RC_GTEST_PROP(AdaptiveGains, NeverFallBelowZero, ()) {
  AdaptiveGain gain(anyMagnitude(-6, 2), anyMagnitude(-3, 3));
  const int count = *rc::gen::inRange(1, 50);
  for (int i = 0; i < count; ++i) {
    gain.step(*rc::gen::arbitrary<bool>() ? anyMagnitude(-6, 6) : 0.0, anyMagnitude(-9, 9));
    RC_ASSERT(gain.value() >= 0.0);
    RC_ASSERT(std::isfinite(gain.value()));
  }
}

RC_GTEST_PROP(AdaptiveGains, ReachTheClosedFormThroughAnySteps, ()) {
  const double initial = anyMagnitude(-6, 2);
  const double leak = anyMagnitude(-3, 3);
  const double drive = anyReal(-10.0, 10.0);
  AdaptiveGain gain(initial, leak);
  double time = 0.0;
  const int count = *rc::gen::inRange(1, 50);
  for (int i = 0; i < count; ++i) {
    const double dt = anyMagnitude(-6, 0);
    gain.step(drive, dt);
    time += dt;
  }
  const double expected =
      std::exp(-leak * time) * initial - std::expm1(-leak * time) / leak * drive;
  RC_ASSERT(std::abs(gain.value() - expected) <= 1e-12 * (initial + std::abs(drive) / leak));
}

RC_GTEST_PROP(AdaptiveGains, GrowWithTheirDrive, ()) {
  const double initial = anyMagnitude(-6, 2);
  const double leak = anyMagnitude(-3, 3);
  AdaptiveGain weak(initial, leak);
  AdaptiveGain strong(initial, leak);
  const int count = *rc::gen::inRange(1, 30);
  for (int i = 0; i < count; ++i) {
    const double drive = anyMagnitude(-3, 3);
    const double dt = anyMagnitude(-4, 1);
    weak.step(drive, dt);
    strong.step(2.0 * drive, dt);
    RC_ASSERT(strong.value() >= weak.value());
  }
}

}  // namespace
}  // namespace aqc

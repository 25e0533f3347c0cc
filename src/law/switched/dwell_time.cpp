#include "adaptive_quadrotor_control/law/switched/dwell_time.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

// The largest whole number <= a b, exact for whole b up to 2^53: fma() gives what the rounded
// product lost, which matters only where the rounded product is itself a whole number.
Nanoseconds floorOfProduct(double a, Nanoseconds b) {
  const auto factor = static_cast<double>(b);
  const double product = a * factor;
  const double lost = std::fma(a, factor, -product);
  const double whole = std::floor(product);
  return static_cast<Nanoseconds>(whole) - (whole == product && lost < 0.0 ? 1 : 0);
}

bool isPositive(const LyapunovSpectrum& spectrum) {
  return spectrum.p_min > 0.0 && spectrum.p_max >= spectrum.p_min && spectrum.q_min > 0.0 &&
         std::isfinite(spectrum.p_max) && std::isfinite(spectrum.q_min);
}

}  // namespace

std::string DwellTime::text() const {
  std::ostringstream out;
  out.precision(5);
  out << "mu = " << mu << ", varrho = " << varrho << " 1/s, kappa = " << kappa
      << " 1/s, least average dwell time theta* = " << least << " s";
  return out.str();
}

DwellTime averageDwellTime(const std::vector<LyapunovSpectrum>& subsystems, double kappa_ratio) {
  if (subsystems.empty()) throw std::invalid_argument("there must be a subsystem");
  if (!std::all_of(subsystems.begin(), subsystems.end(), isPositive)) {
    throw std::invalid_argument("P and Q of every subsystem must be positive definite");
  }
  if (!(kappa_ratio > 0.0 && kappa_ratio < 1.0)) {
    throw std::invalid_argument("kappa / varrho is " + numberText(kappa_ratio) +
                                "; it must be > 0 and < 1");
  }
  double p_min = subsystems.front().p_min;
  double p_max = subsystems.front().p_max;
  double varrho = subsystems.front().decay();
  for (const LyapunovSpectrum& subsystem : subsystems) {
    p_min = std::min(p_min, subsystem.p_min);
    p_max = std::max(p_max, subsystem.p_max);
    varrho = std::min(varrho, subsystem.decay());
  }
  const double mu = p_max / p_min;
  const double kappa = kappa_ratio * varrho;
  return {mu, varrho, kappa, std::log(mu) / kappa};
}

DwellTimeMonitor::DwellTimeMonitor(Nanoseconds dwell_time, double chatter_bound)
    : dwell_time_(dwell_time), chatter_bound_(chatter_bound), capacity_(0) {
  if (dwell_time < 1 || dwell_time > kLongest) {
    throw std::invalid_argument("the dwell time is " + std::to_string(dwell_time) +
                                " ns; it must be >= 1 and <= " + std::to_string(kLongest));
  }
  if (!(chatter_bound >= 1.0 && chatter_bound <= kMostChatter)) {
    throw std::invalid_argument("the chatter bound N_0 is " + numberText(chatter_bound) +
                                "; it must be >= 1 and <= " + numberText(kMostChatter));
  }
  // The whole part by itself, which keeps the rest of the product far below 2^53.
  const double whole = std::floor(chatter_bound);
  capacity_ = static_cast<Nanoseconds>(whole) * dwell_time +
              floorOfProduct(chatter_bound - whole, dwell_time);
}

Nanoseconds DwellTimeMonitor::earliest(Nanoseconds now) const noexcept {
  const Nanoseconds excess = fill_ + dwell_time_ - capacity_;
  return excess <= 0 ? now : std::max(now, last_ + excess);
}

void DwellTimeMonitor::record(Nanoseconds now) noexcept {
  // A policy that lets illegal switches pass may overfill the bucket without end.
  constexpr Nanoseconds kFullest = 4'000'000'000'000'000'000;
  if (fill_ == 0) last_ = now;
  now = std::max(now, last_);
  fill_ = std::min(std::max<Nanoseconds>(0, fill_ - (now - last_)) + dwell_time_, kFullest);
  last_ = now;
}

void DwellTimeMonitor::adopt(const DwellTimeMonitor& old) noexcept {
  const double switches = static_cast<double>(old.fill_) / static_cast<double>(old.dwell_time_);
  const double fill = std::ceil(switches * static_cast<double>(dwell_time_));
  // An overfilled old bucket may hold more than any whole number of nanoseconds can say here.
  const bool fits = fill < static_cast<double>(capacity_);
  fill_ = fits ? static_cast<Nanoseconds>(fill) : capacity_;
  last_ = old.last_;
}

void DwellTimeMonitor::reset() noexcept {
  fill_ = 0;
  last_ = 0;
}

}  // namespace aqc

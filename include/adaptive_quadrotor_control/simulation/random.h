#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace aqc {

/// A seed of two numbers by SplitMix64 (Steele, Lea and Flood 2014): neighbouring ones become
/// unlike seeds.
inline std::uint64_t mixedSeed(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed + (stream + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// Random numbers of a seed. The distributions of the standard library differ from one library to
/// the next; these are the same on every platform, of an engine that the standard fixes.
class Random {
 public:
  /// Streams of one seed are independent of each other.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : engine_(mixedSeed(seed, stream)) {}

  /// In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  /// True with a probability of `share`, 0 to 1.
  bool chance(double share) { return uniform() < share; }
  /// Of mean 0 and standard deviation 1. Ratio of uniforms (Kinderman and Monahan 1977): the
  /// logarithm, whose last bit is not the same in every library, judges but is no part of the
  /// value.
  double normal() {
    constexpr double kSide = 0.8577638849607068;  // sqrt(2 / e)
    for (;;) {
      const double u = 1.0 - uniform();
      const double ratio = kSide * (2.0 * uniform() - 1.0) / u;
      if (ratio * ratio <= -4.0 * std::log(u)) return ratio;
    }
  }
  Eigen::Vector3d normal3() {
    const double x = normal();
    const double y = normal();
    return {x, y, normal()};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace aqc

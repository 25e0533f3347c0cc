#pragma once

#include <cfenv>

namespace aqc::test {

/// While it lives, a division by zero, an invalid operation (0 / 0, a comparison with not-a-number)
/// or an overflow ends the program by SIGFPE, at the instruction that does it. For simulations that
/// must get by without. Has no effect where kTrap is false.
class FloatTraps {
 public:
#if defined(__GLIBC__) && defined(__x86_64__)
  static constexpr bool kTrap = true;

  FloatTraps() : before_(fegetexcept()) {
    std::feclearexcept(kTraps);
    feenableexcept(kTraps);
  }
  ~FloatTraps() {
    std::feclearexcept(kTraps);
    fedisableexcept(kTraps);
    feenableexcept(before_);
  }

 private:
  static constexpr int kTraps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;
  int before_;
#else
  static constexpr bool kTrap = false;

  FloatTraps() {}
  ~FloatTraps() {}
#endif

 public:
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;
};

}  // namespace aqc::test

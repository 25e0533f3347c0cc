// Every group of numbers that a message has takes every kind of number, all combinations of them:
// whatever is said once to a pilot in a hover, the rotors stay within their range. A guard also
// keeps the law finite; without one that is not promised, for a huge state is a valid one.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>

#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A pilot that hears of a hover, and steps by timer.
class Hover {
 public:
  Hover(const std::string& law, bool guarded)
      : vehicle_(test::vehicleNamed(law == "switched" ? "lifter_lag" : "pelican_thesis")),
        pilot_(vehicle_, test::lawNamed(law, vehicle_), kPeriod, StepClock::Trigger::kTimer,
               limits(guarded)) {
    state_.position = {0.5, -0.5, 2.0};
    if (guarded) {
      pilot_.guard()->wasArmed();
    } else {
      SetPoint place;
      place.position = state_.position + Eigen::Vector3d::Constant(0.1);
      pilot_.plan({{now_, place}}, now_, now_);
    }
    for (int i = 0; i < 50; ++i) advance();
    EXPECT_TRUE(pilot_.flying());
  }

  void advance() {
    pilot_.hear(state_, now_, now_);
    pilot_.hear(specificForce(), state_.body_rate, now_);
    step();
  }
  void step() {
    pilot_.tick(now_);
    now_ += kPeriod;
  }
  bool inRange() const {
    const RotorArray& speeds = pilot_.allocation().speeds;
    return speeds.allFinite() && speeds.minCoeff() >= 0.0 &&
           speeds.maxCoeff() <= vehicle_.max_rotor_speed;
  }
  bool lawIsFinite() const {
    return pilot_.law().finite() && pilot_.law().telemetry().adaptive.allFinite();
  }
  bool sameAs(const Hover& other) const {
    return test::sameBits(pilot_.allocation().speeds, other.pilot_.allocation().speeds) &&
           test::sameBits(pilot_.law().telemetry().adaptive,
                          other.pilot_.law().telemetry().adaptive);
  }
  static Eigen::Vector3d specificForce() { return {0.0, 0.0, kGravity}; }

  const State& state() const { return state_; }
  Nanoseconds now() const { return now_; }
  Pilot& pilot() { return pilot_; }

 private:
  static PilotLimits limits(bool guarded) {
    PilotLimits limits;
    if (guarded) limits.guard = GuardLimits();
    return limits;
  }

  Vehicle vehicle_;
  Pilot pilot_;
  State state_;
  Nanoseconds now_ = 1'000'000'000'000;
};

// What one group of numbers of a message becomes.
class Kinds {
 public:
  static constexpr int kCount = 7;
  explicit Kinds(int combination) : rest_(combination) {}

  static int combinations(int groups) {
    return groups == 0 ? 1 : kCount * combinations(groups - 1);
  }

  // The kind of the next group: that number, or `normal`.
  template <typename Vector>
  Vector next(const Vector& normal) {
    const int kind = take();
    return kind == 0 ? normal : Vector(Vector::Constant(kHuge.at(static_cast<std::size_t>(kind))));
  }
  double next(double normal) {
    const int kind = take();
    return kind == 0 ? normal : kHuge.at(static_cast<std::size_t>(kind));
  }
  const std::string& text() const { return text_; }

 private:
  int take() {
    const int kind = rest_ % kCount;
    rest_ /= kCount;
    text_ += " " + (kind == 0 ? std::string("normal")
                              : std::to_string(kHuge.at(static_cast<std::size_t>(kind))));
    return kind;
  }

  static constexpr std::array<double, kCount> kHuge = {
      0.0, std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e308, 1e30, 0.0};
  int rest_;
  std::string text_;
};

class NumberWalkTest : public ::testing::TestWithParam<std::tuple<const char*, bool>> {
 protected:
  bool guarded() const { return std::get<1>(GetParam()); }
  Hover hover() const { return Hover(std::get<0>(GetParam()), guarded()); }

  // Says `say(pilot, kinds)`, which tells whether it was refused, once for every combination to a
  // pilot in a hover. What was refused must leave no trace: the next command is that of a twin
  // which did not hear it.
  template <typename Say>
  void walk(int groups, const Say& say) {
    std::unique_ptr<Hover> hears, twin;
    int refusals = 0;
    for (int i = 0; i < Kinds::combinations(groups); ++i) {
      if (!hears) {
        hears = std::make_unique<Hover>(hover());
        twin = std::make_unique<Hover>(hover());
      }
      Kinds kinds(i);
      const bool refused = say(*hears, kinds);
      hears->step();
      twin->step();
      ASSERT_TRUE(!refused || hears->sameAs(*twin)) << "refused, but heard:" << kinds.text();
      for (int later = 0; later < (refused ? 1 : 10); ++later) {
        ASSERT_TRUE(hears->inRange()) << later << " periods after" << kinds.text();
        ASSERT_TRUE(!guarded() || hears->lawIsFinite())
            << later << " periods after" << kinds.text();
        hears->advance();
        twin->advance();
      }
      refusals += refused ? 1 : 0;
      if (!refused) hears.reset();
    }
    EXPECT_GT(refusals, 0);
    EXPECT_LT(refusals, Kinds::combinations(groups));
  }

  // Whether these are refused.
  static bool refuses(Hover& hover, const SetPoint& set_point) {
    try {
      hover.pilot().plan({{hover.now(), set_point}}, hover.now(), hover.now());
      return false;
    } catch (const std::invalid_argument&) {
      return true;
    }
  }
};

TEST_P(NumberWalkTest, OneOdometryMessage) {
  walk(4, [](Hover& hover, Kinds& kinds) {
    State state = hover.state();
    state.position = kinds.next(state.position);
    state.velocity = kinds.next(Eigen::Vector3d(0.1, 0.0, -0.1));
    state.attitude.coeffs() = kinds.next(Eigen::Vector4d(0.0, 0.0, 0.0, 1.0));
    state.body_rate = kinds.next(Eigen::Vector3d(0.1, 0.0, -0.1));
    return hover.pilot().hear(state, hover.now(), hover.now()).refusal != nullptr;
  });
}

TEST_P(NumberWalkTest, OneSetPoint) {
  walk(5, [](Hover& hover, Kinds& kinds) {
    SetPoint point;
    point.position = kinds.next(Eigen::Vector3d(1.0, 0.0, 1.5));
    point.velocity = kinds.next(Eigen::Vector3d(0.1, 0.0, -0.1));
    point.acceleration = kinds.next(Eigen::Vector3d(0.2, 0.0, -0.2));
    point.jerk = kinds.next(Eigen::Vector3d(0.3, 0.0, -0.3));
    point.yaw = point.yaw_rate = point.yaw_acceleration = kinds.next(0.1);
    return refuses(hover, point);
  });
}

TEST_P(NumberWalkTest, OneHeading) {
  walk(3, [](Hover& hover, Kinds& kinds) {
    SetPoint point;
    point.position = hover.state().position;
    point.yaw = kinds.next(0.3);
    point.yaw_rate = kinds.next(0.2);
    point.yaw_acceleration = kinds.next(0.1);
    return refuses(hover, point);
  });
}

TEST_P(NumberWalkTest, OneImuSample) {
  walk(2, [](Hover& hover, Kinds& kinds) {
    const Eigen::Vector3d specific_force = kinds.next(Hover::specificForce());
    const Eigen::Vector3d body_rate = kinds.next(Eigen::Vector3d(0.1, 0.0, -0.1));
    return hover.pilot().hear(specific_force, body_rate, hover.now()).refusal != nullptr;
  });
}

TEST_P(NumberWalkTest, OneAccelerometerSample) {
  walk(1, [](Hover& hover, Kinds& kinds) {
    const Eigen::Vector3d specific_force = kinds.next(Hover::specificForce());
    return hover.pilot().hear(specific_force, hover.now()).refusal != nullptr;
  });
}

INSTANTIATE_TEST_SUITE_P(Laws, NumberWalkTest,
                         ::testing::Combine(::testing::Values("asmc", "smc", "geometric",
                                                              "switched", "integral", "l1"),
                                            ::testing::Bool()),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) ? "Guarded" : "Unguarded");
                         });

}  // namespace
}  // namespace aqc

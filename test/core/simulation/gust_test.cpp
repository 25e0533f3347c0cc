#include "adaptive_quadrotor_control/simulation/gust.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;
const Eigen::Vector3d kIntensity(1.5, 0.8, 0.4);

SetGust shape(std::uint64_t seed, double length = 4.0, double speed = 8.0) {
  return {kIntensity, length, speed, seed};
}

// The share of the variance by which gusts `time` seconds apart belong together.
Eigen::Vector3d correlation(double time, double length, double speed) {
  const double a = speed / length;
  const double across = std::exp(-a * time) * (1.0 - 0.5 * a * time);
  return {std::exp(-a * time), across, across};
}

// The mean of a record's products with itself, `lag` entries later, by the variances.
Eigen::Vector3d meanProduct(const std::vector<Eigen::Vector3d>& record, std::size_t lag) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = lag; i < record.size(); ++i) sum += record[i].cwiseProduct(record[i - lag]);
  const Eigen::Vector3d variance = kIntensity.cwiseAbs2();
  return (sum / static_cast<double>(record.size() - lag)).cwiseQuotient(variance);
}

TEST(Gust, HasTheVarianceAndTheCorrelationsOfDrydenWhateverTheStep) {
  // L / V is 0.5 s. A mean over the time T errs by about sqrt(2 (L / V) / T), which is 0.005 for
  // the shorter steps; steps of 1 s are as good as independent.
  for (const double step : {0.05, 1.0}) {
    Gust gust(shape(1), fromSeconds(step));
    std::vector<Eigen::Vector3d> record;
    for (int i = 0; i < 400'000; ++i) {
      record.push_back(gust.velocity());
      gust.advance();
    }
    for (const std::size_t lag : {0, 1, 2, 5, 10, 30}) {
      const Eigen::Vector3d expected = correlation(step * static_cast<double>(lag), 4.0, 8.0);
      EXPECT_LT((meanProduct(record, lag) - expected).cwiseAbs().maxCoeff(), 0.025)
          << "step " << step << ", lag " << lag;
    }
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Vector3d others = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& v : record) {
      mean += v / static_cast<double>(record.size());
      others += Eigen::Vector3d(v.x() * v.y(), v.y() * v.z(), v.z() * v.x()) /
                static_cast<double>(record.size());
    }
    EXPECT_LT(mean.norm(), 0.04) << step;
    EXPECT_LT(others.norm(), 0.03) << "axes are independent";
  }
}

TEST(Gust, IsAsStrongAtItsBeginningAsLater) {
  Eigen::Vector3d begin = Eigen::Vector3d::Zero();
  Eigen::Vector3d next = Eigen::Vector3d::Zero();
  Eigen::Vector3d product = Eigen::Vector3d::Zero();
  constexpr int kSeeds = 20'000;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Gust gust(shape(static_cast<std::uint64_t>(seed)), fromSeconds(0.2));
    const Eigen::Vector3d first = gust.velocity();
    gust.advance();
    begin += first.cwiseAbs2() / kSeeds;
    next += gust.velocity().cwiseAbs2() / kSeeds;
    product += gust.velocity().cwiseProduct(first) / kSeeds;
  }
  const Eigen::Vector3d variance = kIntensity.cwiseAbs2();
  EXPECT_LT((begin.cwiseQuotient(variance) - Eigen::Vector3d::Ones()).norm(), 0.05);
  EXPECT_LT((next.cwiseQuotient(variance) - Eigen::Vector3d::Ones()).norm(), 0.05);
  EXPECT_LT((product.cwiseQuotient(variance) - correlation(0.2, 4.0, 8.0)).norm(), 0.05);
}

TEST(Gust, IsTheSameOfTheSameSeedAndAnotherOfAnother) {
  Gust gust(shape(7), kMillisecond);
  Gust same(shape(7), kMillisecond);
  const Gust other(shape(8), kMillisecond);
  EXPECT_GT((gust.velocity() - other.velocity()).norm(), 1e-3);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(test::sameBits(gust.velocity(), same.velocity()));
    gust.advance();
    same.advance();
  }
}

TEST(Gust, IsFiniteForEveryStepThatMayBeAskedFor) {
  for (const double length : {0.1, 1e4}) {
    for (const double speed : {0.1, 100.0}) {
      for (const Nanoseconds step : {Nanoseconds{10'000}, Nanoseconds{1'000'000'000}}) {
        Gust gust(shape(1, length, speed), step);
        for (int i = 0; i < 100; ++i) gust.advance();
        EXPECT_TRUE(gust.velocity().allFinite()) << length << ", " << speed << ", " << step;
        EXPECT_LT(gust.velocity().norm(), 10.0);
      }
    }
  }
}

/// A vehicle that keeps its attitude, high up, on rotors that carry it.
class GustyPlant : public testing::Test {
 protected:
  GustyPlant() : vehicle_(test::pelican()) { vehicle_.inertia *= 1e9; }

  TimedPlant plant() const {
    State state;
    state.position.z() = 1000.0;
    return TimedPlant(std::make_unique<RigidPlant>(vehicle_, state), {}, kMillisecond);
  }
  RotorArray hover() const { return test::hoverSpeeds(vehicle_, vehicle_.mass); }

  Vehicle vehicle_;
};

TEST_F(GustyPlant, MeetsGustsOnTopOfTheWindUntilTheyEnd) {
  TimedPlant plant = this->plant();
  const Eigen::Vector3d wind(3.0, -1.0, 0.5);
  plant.schedule({2 * kMillisecond, SetWind{wind}});
  plant.schedule({5 * kMillisecond, shape(3)});
  plant.schedule({9 * kMillisecond, SetWind{-wind}});
  plant.schedule({20 * kMillisecond, SetGust()});
  plant.advance(hover(), 6 * kMillisecond);
  Gust gust(shape(3), kMillisecond);
  for (int i = 6; i < 20; ++i) {
    gust.advance();
    plant.advance(hover(), i * kMillisecond);
    const Eigen::Vector3d expected = (i <= 9 ? 1.0 : -1.0) * wind + gust.velocity();
    EXPECT_TRUE(test::sameBits(plant.wind(), expected)) << i;
  }
  plant.advance(hover(), 21 * kMillisecond);
  EXPECT_EQ(plant.wind(), -wind);
}

TEST_F(GustyPlant, IsDraggedAlongByThem) {
  TimedPlant plant = this->plant();
  plant.advance(hover(), 1000 * kMillisecond);  // the rotors turn at one speed from here on
  plant.schedule({1000 * kMillisecond, shape(5)});
  Gust gust(shape(5), kMillisecond);
  // v' = -rate (v - gust), where the gust is held over a step; across the rotors' axes only.
  const double rate = vehicle_.drag_coefficient * hover().sum() / vehicle_.mass;
  const double left = std::exp(-rate * 1e-3);
  Eigen::Vector3d expected = plant.plant().state().velocity;
  for (int i = 1; i <= 3000; ++i) {
    const Eigen::Vector3d air = gust.velocity();
    expected.head<2>() = (air + left * (expected - air)).head<2>();
    gust.advance();
    plant.advance(hover(), (1000 + i) * kMillisecond);
  }
  EXPECT_GT(expected.head<2>().norm(), 0.01);
  EXPECT_LT((plant.plant().state().velocity - expected).norm(), 1e-8);
}

TEST_F(GustyPlant, DoesNotFeelThemWithoutDrag) {
  vehicle_.drag_coefficient = vehicle_.rolling_moment_coefficient = 0.0;
  TimedPlant calm = plant();
  TimedPlant gusty = plant();
  gusty.schedule({0, shape(1)});
  calm.advance(hover(), 500 * kMillisecond);
  gusty.advance(hover(), 500 * kMillisecond);
  EXPECT_EQ(calm.plant().state().velocity, gusty.plant().state().velocity);
}

TEST_F(GustyPlant, MeetsTheSameGustsHoweverTheTimeIsCut) {
  TimedPlant once = plant();
  TimedPlant often = plant();
  for (TimedPlant* plant : {&once, &often}) plant->schedule({7 * kMillisecond, shape(11)});
  once.advance(hover(), 40 * kMillisecond);
  for (int i = 1; i <= 40; ++i) often.advance(hover(), i * kMillisecond);
  EXPECT_TRUE(test::sameBits(once.plant().state(), often.plant().state()));
}

}  // namespace
}  // namespace aqc

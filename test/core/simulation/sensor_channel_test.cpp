#include "adaptive_quadrotor_control/simulation/sensor_channel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;
constexpr Nanoseconds kPeriod = 10 * kMillisecond;

OdometryFaults perfect() {
  OdometryFaults faults;
  faults.period = kPeriod;
  return faults;
}

State somewhere() {
  return test::Dice(1).airborneState();
}

// All that arrives in `count` periods of which each begins with the state of truth(time).
template <class Truth>
std::vector<OdometryMessage> heardOf(const OdometryFaults& faults, int count, Truth truth,
                                     std::uint64_t seed = 1) {
  OdometryChannel channel(faults, seed, 0);
  std::vector<OdometryMessage> messages;
  for (Nanoseconds now = 0; now < count * kPeriod; now += kMillisecond) {
    channel.observe(truth(now), now);
    while (const auto message = channel.receive(now)) {
      EXPECT_LE(message->arrival, now);
      messages.push_back(*message);
    }
  }
  return messages;
}

std::vector<OdometryMessage> heard(const OdometryFaults& faults, int count,
                                   std::uint64_t seed = 1) {
  return heardOf(
      faults, count, [state = somewhere()](Nanoseconds) { return state; }, seed);
}

TEST(OdometryChannel, WithoutFaultsTellsTheTruthAtOnceToTheLastBit) {
  const std::vector<OdometryMessage> messages = heard(perfect(), 5);
  ASSERT_EQ(messages.size(), 5u);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].stamp, static_cast<Nanoseconds>(i) * kPeriod);
    EXPECT_EQ(messages[i].arrival, messages[i].stamp);
    EXPECT_TRUE(test::sameBits(messages[i].state, somewhere()));
  }
}

TEST(OdometryChannel, DelaysExactlyAndTheStampIsThatOfTheMeasurement) {
  OdometryFaults faults = perfect();
  faults.delay = 13 * kMillisecond;
  const std::vector<OdometryMessage> messages = heard(faults, 10);
  ASSERT_EQ(messages.size(), 9u);
  for (const OdometryMessage& message : messages) {
    EXPECT_EQ(message.arrival, message.stamp + 13 * kMillisecond);
  }
}

// Of independent vehicles: as large at the start as later, the same in a third of tau by exp(-1/3).
TEST(OdometryChannel, WandersSlowlyAndWithinBounds) {
  OdometryFaults faults = perfect();
  faults.wander = {0.02, 0.005, 0.3};
  double first = 0.0, last = 0.0, both = 0.0, lean = 0.0;
  constexpr int kVehicles = 2000;
  for (std::uint64_t seed = 1; seed <= kVehicles; ++seed) {
    const std::vector<OdometryMessage> messages = heard(faults, 11, seed);
    const Eigen::Vector3d one = messages.front().state.position - somewhere().position;
    const Eigen::Vector3d other = messages.back().state.position - somewhere().position;
    first += one.squaredNorm() / (3 * kVehicles);
    last += other.squaredNorm() / (3 * kVehicles);
    both += one.dot(other) / (3 * kVehicles);
    const double angle = test::angleBetween(messages.back().state.attitude, somewhere().attitude);
    lean += angle * angle / (3 * kVehicles);
  }
  EXPECT_NEAR(std::sqrt(first), 0.02, 0.0006);
  EXPECT_NEAR(std::sqrt(last), 0.02, 0.0006);
  EXPECT_NEAR(both / last, std::exp(-1.0 / 3.0), 0.04);
  EXPECT_NEAR(std::sqrt(lean), 0.005, 0.00015);
}

TEST(OdometryChannel, JitterStretchesTheDelayButKeepsTheOrder) {
  OdometryFaults faults = perfect();
  faults.jitter = 40 * kMillisecond;
  Nanoseconds last = -1;
  Nanoseconds longest = 0;
  for (const OdometryMessage& message : heard(faults, 500)) {
    EXPECT_GT(message.stamp, last);
    last = message.stamp;
    longest = std::max(longest, message.arrival - message.stamp);
  }
  EXPECT_LE(longest, faults.jitter);
  EXPECT_GT(longest, 35 * kMillisecond);
}

TEST(OdometryChannel, NoiseHasItsStandardDeviation) {
  OdometryFaults faults = perfect();
  faults.noise = {0.1, 0.2, 0.01, 0.3};
  Eigen::Vector4d squares = Eigen::Vector4d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const State truth = somewhere();
  const std::vector<OdometryMessage> messages = heard(faults, 5000);
  for (const auto& [state, stamp, arrival] : messages) {
    const double angle = test::angleBetween(state.attitude, truth.attitude);
    squares += Eigen::Vector4d((state.position - truth.position).squaredNorm(),
                               (state.velocity - truth.velocity).squaredNorm(), angle * angle,
                               (state.body_rate - truth.body_rate).squaredNorm());
    mean += state.position - truth.position;
    EXPECT_TRUE(state.valid());
  }
  const double count = 3.0 * static_cast<double>(messages.size());
  const Eigen::Vector4d share =
      (squares / count).cwiseSqrt().cwiseQuotient(Eigen::Vector4d(0.1, 0.2, 0.01, 0.3));
  EXPECT_TRUE(((share.array() - 1.0).abs() < 0.03).all()) << share.transpose();
  EXPECT_LT((mean / (count / 3.0)).norm(), 0.01);
}

TEST(OdometryChannel, DriftIsARandomWalk) {
  OdometryFaults faults = perfect();
  faults.position_drift = 0.1;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const State last = heard(faults, 400, seed).back().state;
    squares += (last.position - somewhere().position).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / 900.0), 0.1 * std::sqrt(4.0), 0.015) << "after 4 s";
}

TEST(OdometryChannel, LosesDoublesAndReordersShares) {
  OdometryFaults faults = perfect();
  faults.dropped = 0.3;
  EXPECT_NEAR(static_cast<double>(heard(faults, 5000).size()), 3500.0, 150.0);
  faults = perfect();
  faults.duplicated = 0.2;
  EXPECT_NEAR(static_cast<double>(heard(faults, 5000).size()), 6000.0, 150.0);
  faults = perfect();
  faults.reordered = 0.1;
  int back = 0;
  Nanoseconds last = -1;
  for (const OdometryMessage& message : heard(faults, 5000)) {
    if (message.stamp < last) ++back;
    last = message.stamp;
  }
  EXPECT_NEAR(back, 450, 80);
}

TEST(OdometryChannel, TheSeedDecidesEveryBit) {
  OdometryFaults faults = perfect();
  faults.noise.position = 0.1;
  faults.dropped = 0.2;
  const std::vector<OdometryMessage> first = heard(faults, 100, 7);
  const std::vector<OdometryMessage> again = heard(faults, 100, 7);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(test::sameBits(first[i].state, again[i].state));
  }
  EXPECT_FALSE(test::sameBits(first[0].state, heard(faults, 100, 8)[0].state));
}

TEST(OdometryChannel, IsSilentFreezesAndGoesMadInTheirWindows) {
  OdometryFaults faults = perfect();
  faults.gaps = {{2 * kPeriod, 4 * kPeriod}};
  faults.freezes = {{5 * kPeriod, 8 * kPeriod}};
  faults.not_a_number = {{8 * kPeriod, 9 * kPeriod}};
  const auto truth = [](Nanoseconds now) {
    State state;
    state.position.x() = static_cast<double>(now / kPeriod);
    return state;
  };
  const std::vector<OdometryMessage> messages = heardOf(faults, 10, truth);
  ASSERT_EQ(messages.size(), 8u);
  const std::vector<double> expected = {0, 1, 4, 5, 5, 5};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(messages[i].state.position.x(), expected[i]);
  }
  EXPECT_EQ(messages[5].stamp, 7 * kPeriod) << "a frozen state has new stamps";
  EXPECT_FALSE(messages[6].state.valid());
  EXPECT_EQ(messages[7].state.position.x(), 9.0);
}

TEST(OdometryChannel, AJumpTurnsTheWorldAboutTheVehicleAndMayEnd) {
  OdometryFaults faults = perfect();
  faults.jumps = {{{kPeriod, 3 * kPeriod}, {1.0, 2.0, 0.0}, M_PI_2}};
  const auto truth = [](Nanoseconds now) {
    State state;
    state.position = {5.0 + static_cast<double>(now / kPeriod), 0.0, 1.0};
    state.velocity = {1.0, 0.0, 0.0};
    return state;
  };
  const std::vector<OdometryMessage> messages = heardOf(faults, 4, truth);
  ASSERT_EQ(messages.size(), 4u);
  EXPECT_LT((messages[1].state.position - Eigen::Vector3d(7.0, 2.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((messages[1].state.velocity - Eigen::Vector3d(0.0, 1.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(rollPitchYaw(messages[1].state.attitude).z(), M_PI_2, 1e-12);
  EXPECT_LT((messages[2].state.position - Eigen::Vector3d(7.0, 3.0, 1.0)).norm(), 1e-12)
      << "what moves along x moves along y";
  EXPECT_LT((messages[3].state.position - Eigen::Vector3d(8.0, 0.0, 1.0)).norm(), 1e-12);
}

TEST(OdometryChannel, StampsLieInTheirWindow) {
  OdometryFaults faults = perfect();
  faults.stamps = {{{kPeriod, 2 * kPeriod}, 7 * kMillisecond}};
  const std::vector<OdometryMessage> messages = heard(faults, 3);
  EXPECT_EQ(messages[0].stamp, 0);
  EXPECT_EQ(messages[1].stamp, 17 * kMillisecond);
  EXPECT_EQ(messages[1].arrival, kPeriod);
  EXPECT_EQ(messages[2].stamp, 2 * kPeriod);
}

TEST(ImuChannel, AddsBiasAndNoiseAndFallsSilent) {
  ImuFaults faults;
  faults.period = kPeriod;
  faults.force_bias = {0.1, 0.0, 0.0};
  faults.rate_bias = {0.0, 0.2, 0.0};
  faults.rate_noise = 0.05;
  faults.delay = 2 * kMillisecond;
  faults.gaps = {{1000 * kPeriod, 2000 * kPeriod}};
  ImuChannel channel(faults, 3, 0);
  double squares = 0.0;
  int count = 0;
  for (Nanoseconds now = 0; now < 2000 * kPeriod; now += kMillisecond) {
    channel.observe({0.0, 0.0, kGravity}, Eigen::Vector3d::Zero(), now);
    while (const auto message = channel.receive(now)) {
      EXPECT_EQ(message->specific_force, Eigen::Vector3d(0.1, 0.0, kGravity));
      EXPECT_EQ(message->arrival, message->stamp + 2 * kMillisecond);
      squares += (message->body_rate - faults.rate_bias).squaredNorm();
      ++count;
    }
  }
  EXPECT_EQ(count, 1000);
  EXPECT_NEAR(std::sqrt(squares / (3.0 * count)), 0.05, 0.002);
}

TEST(Random, IsTheSameOnEveryPlatform) {
  Random random(1);
  const double uniform = random.uniform();
  const double normal = random.normal();
  EXPECT_EQ(uniform, 0x1.109f48cd2b630p-1);
  EXPECT_EQ(normal, -0x1.8044f7edaf989p+0);
  EXPECT_NE(Random(1, 1).uniform(), uniform) << "another stream";
  EXPECT_NE(Random(2).uniform(), uniform) << "another seed";
}

TEST(Random, NormalNumbersHaveTheMomentsAndTailsOfTheirName) {
  Random random(5);
  constexpr int kCount = 200000;
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    if (std::abs(x) > 2.0) ++beyond_two;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.015);
  EXPECT_NEAR(fourth / kCount, 3.0, 0.1);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 0.002);
}

TEST(SensorFaults, AreReadWithTheirUnits) {
  const ParameterReader reader = test::readerOf(R"(
seed: 4
clock_steps: [{at: 5.0, by: -2.0}]
odometry:
  rate: 50.0
  delay: 0.02
  noise: {attitude_deg: 1.0}
  jumps: [{from: 3.0, yaw_deg: 90.0}]
imu: {bias: {body_rate: [0.1, 0.0, 0.0]}, gaps: [{from: 1.0, until: 2.0}]}
)",
                                                "sensors");
  const SensorFaults faults = readSensorFaults(reader, kPeriod);
  reader.finish();
  EXPECT_EQ(faults.seed, 4u);
  EXPECT_EQ(faults.odometry.period, 20 * kMillisecond);
  EXPECT_EQ(faults.odometry.delay, 20 * kMillisecond);
  EXPECT_NEAR(faults.odometry.noise.attitude, M_PI / 180.0, 1e-15);
  EXPECT_NEAR(faults.odometry.jumps.at(0).yaw, M_PI_2, 1e-15);
  EXPECT_TRUE(faults.odometry.jumps[0].window.contains(fromSeconds(1e6))) << "for ever";
  EXPECT_EQ(faults.imu.period, kPeriod) << "that of control";
  EXPECT_EQ(faults.imu.gaps.at(0).until, fromSeconds(2.0));
  EXPECT_EQ(faults.imu.stamps.at(0).offset, fromSeconds(-2.0)) << "the clock of both";
  EXPECT_EQ(faults.odometry.stamps.at(0).offset, fromSeconds(-2.0));
}

TEST(SensorFaults, AreRefusedWithTheReason) {
  const auto read = [](const std::string& text) {
    readSensorFaults(test::readerOf(text, "sensors"), kPeriod);
  };
  test::expectRefusal([&] { read("odometry: {}"); }, {"sensors/seed"});
  test::expectRefusal([&] { read("{seed: 1, odometry: {dropped: 1.5}}"); },
                      {"odometry/dropped", "1.5", ">= 0 and <= 1"});
  test::expectRefusal([&] { read("{seed: 1, imu: {gaps: [{from: 2.0, until: 1.0}]}}"); },
                      {"imu/gaps[0]/until", "after 'from' '2.0'"});
}

}  // namespace
}  // namespace aqc

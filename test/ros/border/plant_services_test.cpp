#include "ros/border/plant_services.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/refusal.h"

namespace aqc {
namespace {

constexpr int kTrials = 300;
const ros::Time kAt(12, 345);

class PlantServices : public testing::Test {
 protected:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  // Of any size within six decades.
  double positive(double most = 1e3) { return most * std::pow(10.0, number(-6.0, 0.0)); }
  Eigen::Vector3d vector(double limit) {
    return {number(-limit, limit), number(-limit, limit), number(-limit, limit)};
  }
  // Of some points of mass, all entries other than zero.
  Eigen::Matrix3d inertia() {
    Eigen::Matrix3d points;
    points << vector(1.0), vector(1.0), vector(1.0);
    const Eigen::Matrix3d spread = points * points.transpose();
    Eigen::Matrix3d matrix = positive() * (spread.trace() * Eigen::Matrix3d::Identity() - spread);
    matrix.diagonal() *= 1.1;  // away from the edge
    return matrix.selfadjointView<Eigen::Lower>();
  }

 private:
  std::mt19937 random_{7};
};

// What is left of an action after its way through a request.
template <class Action>
Action sent(const Action& action) {
  const auto request = toRequest(action, kAt);
  EXPECT_EQ(request.at, kAt);
  return toAction(request);
}

TEST_F(PlantServices, CarryAPayloadWithItsWholeInertia) {
  for (int i = 0; i < kTrials; ++i) {
    AttachPayload attach{"box " + std::to_string(i), {}};
    attach.payload.mass = positive();
    attach.payload.size = {positive(10.0), positive(10.0), positive(10.0)};
    attach.payload.offset = vector(10.0);
    attach.payload.inertia = inertia();
    const AttachPayload heard = sent(attach);
    EXPECT_EQ(heard.name, attach.name);
    EXPECT_EQ(heard.payload.mass, attach.payload.mass);
    EXPECT_EQ(heard.payload.size, attach.payload.size);
    EXPECT_EQ(heard.payload.offset, attach.payload.offset);
    EXPECT_EQ(heard.payload.inertia, attach.payload.inertia);
  }
}

TEST_F(PlantServices, CarryWhatHoldsAPayload) {
  AttachPayload attach{"box", {}};
  attach.payload.mass = 0.4;
  attach.payload.size.setConstant(0.1);
  attach.payload.inertia = boxInertia(0.4, attach.payload.size);
  EXPECT_TRUE(sent(attach).payload.rigid());
  for (int i = 0; i < kTrials; ++i) {
    const Joint joint{number(0.1, 200.0), i == 0 ? 0.0 : number(0.0, 2.0)};
    attach.payload.mount = joint;
    const AttachPayload with_joint = sent(attach);
    const auto* heard = std::get_if<Joint>(&with_joint.payload.mount);
    ASSERT_NE(heard, nullptr);
    EXPECT_EQ(heard->frequency, joint.frequency);
    EXPECT_EQ(heard->damping, joint.damping);
    attach.payload.mount = Cable{number(0.05, 100.0)};
    const AttachPayload with_cable = sent(attach);
    const auto* cable = std::get_if<Cable>(&with_cable.payload.mount);
    ASSERT_NE(cable, nullptr);
    EXPECT_EQ(cable->length, std::get<Cable>(attach.payload.mount).length);
  }
}

TEST_F(PlantServices, RefuseAPayloadOnJointAndCable) {
  auto request = toRequest(AttachPayload{"", {}}, kAt);
  request.mass = 0.4;
  request.size = toVector3({0.1, 0.1, 0.1});
  request.joint_frequency = 9.0;
  request.cable_length = 1.0;
  EXPECT_THROW(toAction(request), ParameterError);
  request.joint_frequency = 0.0;
  EXPECT_NO_THROW(toAction(request));
  request.cable_length = -1.0;
  EXPECT_THROW(toAction(request), ParameterError);
}

TEST_F(PlantServices, CarryABodyWithItsWholeInertia) {
  for (int i = 0; i < kTrials; ++i) {
    const SetBody body{1e-3 + positive(900.0), inertia()};
    const SetBody heard = sent(body);
    EXPECT_EQ(heard.mass, body.mass);
    EXPECT_EQ(heard.inertia, body.inertia);
  }
  const Eigen::Matrix3d diagonal = Eigen::Vector3d(0.01, 0.02, 0.03).asDiagonal();
  EXPECT_EQ(sent(SetBody{1.0, diagonal}).inertia, diagonal);
}

TEST_F(PlantServices, CarryWindAndDisturbance) {
  for (int i = 0; i < kTrials; ++i) {
    const SetWind wind{vector(30.0)};
    EXPECT_EQ(sent(wind).velocity, wind.velocity);
    // Up to 11 days to the nanosecond, which seconds in a double would not hold for long.
    const auto duration = static_cast<Nanoseconds>(number(1.0, 1e15));
    const ApplyDisturbance disturbance{duration, {vector(9.0), vector(9.0)}, number(0.0, 1e3)};
    const ApplyDisturbance heard = sent(disturbance);
    EXPECT_EQ(heard.duration, duration);
    EXPECT_EQ(heard.amplitude.force, disturbance.amplitude.force);
    EXPECT_EQ(heard.amplitude.moment, disturbance.amplitude.moment);
    EXPECT_EQ(heard.angular_frequency, disturbance.angular_frequency);
  }
  EXPECT_EQ(toRequest(DetachPayload{}, kAt).at, kAt);
}

TEST_F(PlantServices, CarryTheConditionOfARotor) {
  for (int i = 0; i < kTrials; ++i) {
    SetRotor rotor{1 + i % kMaxRotors, {number(0.0, 1.0), std::nullopt, number(1.0, 1e3)}};
    if (i % 3 == 0) rotor.condition.stuck_at = number(0.0, 1e3);
    const SetRotor heard = sent(rotor);
    EXPECT_EQ(heard.number, rotor.number);
    EXPECT_EQ(heard.condition.effectiveness, rotor.condition.effectiveness);
    EXPECT_EQ(heard.condition.stuck_at, rotor.condition.stuck_at);
    EXPECT_EQ(heard.condition.slower, rotor.condition.slower);
  }
  EXPECT_EQ(sent(SetRotor{1, {1.0, 0.0, 1.0}}).condition.stuck_at, 0.0) << "a blocked motor";
}

TEST_F(PlantServices, CarryTheBattery) {
  for (int i = 0; i < kTrials; ++i) {
    const SetBattery battery{number(1e-3, 1.0), static_cast<Nanoseconds>(number(0.0, 1e15))};
    EXPECT_EQ(sent(battery).voltage, battery.voltage);
    EXPECT_EQ(sent(battery).over, battery.over);
  }
}

TEST_F(PlantServices, CarryGusts) {
  for (int i = 0; i < kTrials; ++i) {
    const SetGust gust{vector(9.0).cwiseAbs(), number(0.1, 1e4), number(0.1, 100.0),
                       static_cast<std::uint64_t>(number(0.0, 2e9))};
    const SetGust heard = sent(gust);
    EXPECT_EQ(heard.intensity, gust.intensity);
    EXPECT_EQ(heard.length, gust.length);
    EXPECT_EQ(heard.speed, gust.speed);
    EXPECT_EQ(heard.seed, gust.seed);
  }
  EXPECT_EQ(toAction(msgs::SetGust::Request()).length, SetGust().length) << "when not given";
  EXPECT_EQ(toAction(msgs::SetGust::Request()).speed, SetGust().speed) << "when not given";
}

TEST_F(PlantServices, CarryLostCommands) {
  for (int i = 0; i < kTrials; ++i) {
    const LoseCommands loss{number(0.0, 1.0), static_cast<Nanoseconds>(number(1.0, 1e15)),
                            static_cast<std::uint64_t>(number(0.0, 2e9))};
    EXPECT_EQ(sent(loss).share, loss.share);
    EXPECT_EQ(sent(loss).duration, loss.duration);
    EXPECT_EQ(sent(loss).seed, loss.seed);
  }
  EXPECT_EQ(test::refusal<ParameterError>([] { toAction(msgs::LoseCommands::Request()); }),
            "parameter 'lose_commands/for_so_long' is '0'; it must be a finite number > 0 and <= "
            "1000000");
}

msgs::AttachPayload::Request box() {
  msgs::AttachPayload::Request request;
  request.mass = 1.2;
  request.size = toVector3({0.1, 0.2, 0.3});
  return request;
}

TEST(PlantServiceRefusals, APayloadWithoutInertiaIsASolidBox) {
  EXPECT_EQ(toAction(box()).payload.inertia, boxInertia(1.2, {0.1, 0.2, 0.3}));
}

TEST(PlantServiceRefusals, NameWhatIsWrongWithAPayload) {
  const auto refusal = [](const msgs::AttachPayload::Request& request) {
    return test::refusal<ParameterError>([&] { toAction(request); });
  };
  msgs::AttachPayload::Request request = box();
  request.mass = -1.0;
  EXPECT_EQ(refusal(request),
            "parameter 'payload/mass' is '-1'; it must be a finite number > 0 and <= 1000");
  request = box();
  request.size.y = 0.0;
  EXPECT_EQ(refusal(request),
            "parameter 'payload/size[1]' is '0'; it must be a finite number > 0 and <= 10");
  request = box();
  request.mass = 1e308;
  EXPECT_EQ(refusal(request),
            "parameter 'payload/mass' is '1e+308'; it must be a finite number > 0 and <= 1000");
  request = box();
  request.offset.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(request),
            "parameter 'payload/offset[2]' is 'nan'; it must be a finite number >= -10 and <= 10");
  request = box();
  request.products.x = 0.5;  // products alone are no inertia
  EXPECT_EQ(refusal(request),
            "parameter 'payload/inertia' is [0, 0, 0, 0.5, 0, 0], whose smallest eigenvalue is "
            "-0.5; it must be positive definite (every eigenvalue > 0)");
}

TEST(PlantServiceRefusals, NameWhatIsWrongWithABody) {
  const auto refusal = [](double mass, const Eigen::Vector3d& products) {
    msgs::SetBody::Request request;
    request.mass = mass;
    request.inertia = toVector3({1.0, 1.0, 1.0});
    request.products = toVector3(products);
    return test::refusal<ParameterError>([&] { toAction(request); });
  };
  EXPECT_EQ(refusal(1.0, {0.5, 0.0, 0.0}), "");
  EXPECT_EQ(refusal(0.0, {0.0, 0.0, 0.0}),
            "parameter 'body/mass' is '0'; it must be a finite number >= 0.001 and <= 1000");
  EXPECT_NE(refusal(1e-300, {0.0, 0.0, 0.0}), "");
  EXPECT_EQ(refusal(1.0, {0.0, 0.0, 2.0}),
            "parameter 'body/inertia' is [1, 1, 1, 0, 0, 2], whose smallest eigenvalue is -1; it "
            "must be positive definite (every eigenvalue > 0)");
}

TEST(PlantServiceRefusals, NameWhatIsWrongWithWindAndDisturbance) {
  msgs::SetWind::Request wind;
  wind.velocity.x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(test::refusal<ParameterError>([&] { toAction(wind); }),
            "parameter 'wind/velocity[0]' is 'inf'; it must be a finite number >= -200 and <= 200");
  msgs::SetRotor::Request rotor;
  EXPECT_EQ(test::refusal<ParameterError>([&] { toAction(rotor); }),
            "parameter 'rotor/number' is '0'; it must be a finite number >= 1 and <= 16");
  rotor.number = 1;
  EXPECT_EQ(toAction(rotor).condition.slower, 1.0) << "when it is not given";
  msgs::ApplyDisturbance::Request disturbance;
  const auto refusal = [&disturbance] {
    return test::refusal<ParameterError>([&] { toAction(disturbance); });
  };
  EXPECT_EQ(refusal(),
            "parameter 'disturbance/for_so_long' is '0'; it must be a finite number > 0 and <= "
            "1000000");
  disturbance.for_so_long = ros::Duration(1.0);
  EXPECT_EQ(refusal(), "");
  disturbance.angular_frequency = -1.0;
  EXPECT_EQ(refusal(),
            "parameter 'disturbance/angular_frequency' is '-1'; it must be a finite number >= 0 "
            "and <= 1000");
  disturbance.angular_frequency = 0.0;
  disturbance.force.z = -1e308;
  EXPECT_EQ(refusal(),
            "parameter 'disturbance/force[2]' is '-1e+308'; it must be a finite number >= -100000 "
            "and <= 100000");
}

}  // namespace
}  // namespace aqc

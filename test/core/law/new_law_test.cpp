#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "adaptive_quadrotor_control/law/cascaded_law.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "support/fixtures.h"

// All that a new control law is: this class and its parameters. In the package the class would have
// a header and a source, the parameters a file of config/controller, and the factory one more line.
namespace aqc {
namespace {

class Springs final : public CascadedLaw {
 public:
  Springs(const ParameterReader& reader, const Vehicle& vehicle)
      : CascadedLaw(reader),
        weight_(vehicle.mass * kGravity),
        stiffness_(reader.vector3({"stiffness", "k", "N/m", "pull towards the set point"},
                                  Range::positive())),
        turn_(
            reader.number({"turn", "k_R", "N m/rad", "towards the attitude"}, Range::positive())) {}

  void adapt(const Achieved&, double) noexcept override {}
  void reset() noexcept override {}
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<Springs>(*this); }
  const char* name() const noexcept override { return "springs"; }

 private:
  Eigen::Vector3d force(const PositionErrors& errors, const SetPoint&) noexcept override {
    return weight_ * Eigen::Vector3d::UnitZ() - stiffness_.cwiseProduct(errors.position) -
           stiffness_.cwiseProduct(errors.velocity);
  }
  Eigen::Vector3d moment(const State&, const AttitudeErrors& errors) noexcept override {
    return -turn_ * errors.angle - 0.2 * turn_ * errors.rate;
  }

  double weight_;
  Eigen::Vector3d stiffness_;
  double turn_;
};

const char* const kParameters = R"(
max_tilt_deg: 45
min_lift: 2
stiffness: [4, 4, 6]
turn: 1
)";

TEST(NewLaw, FliesFromThisClassAndItsParametersAlone) {
  const Vehicle vehicle = test::pelican();
  const ParameterReader reader(YAML::Load(kParameters), "springs");
  auto law = std::make_unique<Springs>(reader, vehicle);
  reader.finish();
  Scenario scenario;
  scenario.duration = fromSeconds(10.0);
  scenario.world.control_period = 4'000'000;
  scenario.world.plant_step = 1'000'000;
  scenario.world.start.position.z() = 1.0;
  scenario.mission.set_points.resize(1);
  scenario.mission.set_points[0].set_point.position = {0.5, -0.5, 2.0};
  ClosedLoop loop(scenario, vehicle, std::move(law));
  while (!loop.done()) loop.advance();
  EXPECT_LT(loop.sample().telemetry.position_error.norm(), 0.02);
  EXPECT_FALSE(loop.plant().crashTime());
}

TEST(NewLaw, ItsGainsAreKnownByNameUnitAndRange) {
  const ParameterReader reader(YAML::Load(kParameters), "springs");
  const Springs law(reader, test::pelican());
  bool found = false;
  for (const Parameter& parameter : reader.schema()) {
    if (parameter.key.name != "stiffness") continue;
    found = true;
    EXPECT_EQ(parameter.text(), "k [N/m]: pull towards the set point");
    EXPECT_EQ(parameter.range.text(), Range::positive().text());
    EXPECT_EQ(parameter.numbers, (std::vector<double>{4.0, 4.0, 6.0}));
  }
  EXPECT_TRUE(found);
}

TEST(NewLaw, ACloneIsALawOfItsOwnInTheSameState) {
  const Vehicle vehicle = test::pelican();
  for (const std::string& name : lawNames()) {
    const auto law = test::lawNamed(name, vehicle);
    test::Dice dice(5);
    for (int i = 0; i < 50; ++i) test::step(*law, {dice.airborneState()}, dice.setPoint(), 0.01);
    const auto clone = law->clone();
    EXPECT_STREQ(clone->name(), name.c_str());
    EXPECT_TRUE(test::sameBits(clone->telemetry().adaptive, law->telemetry().adaptive)) << name;
    const State state = dice.airborneState();
    const SetPoint set_point = dice.setPoint();
    // What the one meets meanwhile does not reach the other.
    const auto busy = law->clone();
    for (int i = 0; i < 50; ++i) test::step(*busy, {dice.airborneState()}, dice.setPoint(), 0.01);
    const Wrench original = test::step(*law, {state}, set_point, 0.01);
    const Wrench copy = test::step(*clone, {state}, set_point, 0.01);
    EXPECT_EQ(copy.thrust, original.thrust) << name;
    EXPECT_EQ(copy.moment, original.moment) << name;
  }
}

}  // namespace
}  // namespace aqc

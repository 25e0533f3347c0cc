#include "adaptive_quadrotor_control/law/switched/switched_parameters.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/refusal.h"
#include "support/switched_laws.h"

namespace aqc {
namespace {

using test::makeLaw;
using test::thesisTree;

struct BadParameter {
  const char* name;
  const char* value;
  const char* words;  // of the refusal
};

/// Refused with the bad parameter in `part` of `tree`.
void expectRefused(const YAML::Node& tree, YAML::Node part, const BadParameter& bad) {
  SCOPED_TRACE(bad.name);
  part[bad.name] = YAML::Load(bad.value);
  test::expectRefusal([&tree] { makeLaw(tree); }, {bad.words});
}

TEST(Switched, RefusesParametersByName) {
  const BadParameter of_subsystem[] = {
      {"leak", "[0.6, 0.6, 0.3, 0.6]", "switched/subsystems[1]/leak"},
      {"leak", "[0.6, 0.6, 0.3, 0.6]", "> varrho / 2 = 0.4"},
      {"leak", "[0.6, 0.6, 0.6]", "4 numbers"},
      {"initial_zeta", "0.005", "is '0.005'; it must be > 'zeta_drive' = 0.005"},
      {"initial_gamma", "0.001", "subsystems[1]/initial_gamma"},
      {"initial_theta", "[1, 1, 0, 1]", "> 0"},
      {"zeta_drive", "0", "zeta_drive"},
      {"gamma_drive", "-1", "gamma_drive"},
      {"error_gain", "[1, 1, 1, -1]", "positive definite"},
      {"rate_gain", "[1, 1, 1]", "4 (the diagonal) or 16 (row by row)"},
      {"input_gain", "[1, 2, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]", "symmetric"},
      {"weight", "[1, 1, 1, 1, 1, 1, 1, 0]", "weight"},
      {"wieght", "[1]", "unknown"},
  };
  for (const BadParameter& bad : of_subsystem) {
    YAML::Node tree = thesisTree();
    expectRefused(tree, tree["subsystems"][1], bad);
  }
  const BadParameter of_law[] = {
      {"dwell_time", "6.759", "it must be > theta*"},
      {"chatter_bound", "0.5", ">= 1"},
      {"kappa_ratio", "1.0", "< 1"},
      {"kappa_ratio", "1e-7", "it must be < 1000000 s"},
      {"boundary_layer", "0", "boundary_layer"},
      {"switching_policy", "never", "refuse, warn"},
      {"initial_subsystem", "4", "<= 3"},
      {"acceleration_cut_off", "0", "acceleration_cut_off"},
      {"subsystems", "[]", "1 to 8"},
  };
  for (const BadParameter& bad : of_law) {
    YAML::Node tree = thesisTree();
    expectRefused(tree, tree, bad);
  }
}

TEST(SwitchedLaw, RefusesWhatItsTheoremRulesOut) {
  const SubsystemParameters good = makeLaw(test::plainTree())->law().subsystem(0).parameters();
  const auto refusal = [](const SubsystemParameters& p, double boundary_layer = 0.5) {
    return test::refusal<std::domain_error>([&] { SwitchedLaw({p}, boundary_layer); });
  };
  EXPECT_EQ(refusal(good), "");
  EXPECT_EQ(refusal(good, 0.0), "the boundary layer is 0; it must be > 0");
  SubsystemParameters bad = good;
  bad.leak[2] = 0.25;
  EXPECT_EQ(refusal(bad), "the least alpha is 0.25; it must be > 0.27639320225");
  bad = good;
  bad.initial_theta[1] = -0.5;
  EXPECT_EQ(refusal(bad), "the least initial theta is -0.5; it must be > 0");
  bad = good;
  bad.zeta_drive = 0.0;
  EXPECT_EQ(refusal(bad), "the drive of zeta is 0; it must be > 0");
  bad = good;
  bad.initial_gamma = bad.gamma_drive;
  EXPECT_EQ(refusal(bad), "the initial gamma is 0.01; it must be > 0.01");
  EXPECT_EQ(test::refusal<std::domain_error>([] { SwitchedLaw({}, 0.5); }),
            "there must be a subsystem");
}

TEST(Switched, EnforcesMoreThanTheLeastDwellTime) {
  const auto law = makeLaw(thesisTree());
  EXPECT_GT(toSeconds(law->subsystems()->monitor().dwellTime()), law->subsystems()->bound().least);
  YAML::Node tree = thesisTree();
  tree["dwell_time"] = 10.0;
  EXPECT_EQ(makeLaw(tree)->subsystems()->monitor().dwellTime(), fromSeconds(10.0));
}

TEST(Switched, ReadsAWholeMatrixRowByRow) {
  YAML::Node tree = test::plainTree();
  tree["subsystems"][0]["input_gain"] =
      YAML::Load("[2, 0.1, 0.2, 0.3, 0.1, 3, 0.4, 0.5, 0.2, 0.4, 4, 0.6, 0.3, 0.5, 0.6, 5]");
  Eigen::Matrix4d expected;
  expected << 2.0, 0.1, 0.2, 0.3,  //
      0.1, 3.0, 0.4, 0.5,          //
      0.2, 0.4, 4.0, 0.6,          //
      0.3, 0.5, 0.6, 5.0;
  const auto law = makeLaw(tree);
  EXPECT_EQ(law->law().subsystem(0).parameters().input_gain, expected);
}

}  // namespace
}  // namespace aqc

#include "adaptive_quadrotor_control/law/law_factory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

using test::expectRefusal;
using test::replaced;

std::string textOf(const std::string& law) {
  std::ifstream file(test::configFile("controller/" + law));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void make(const std::string& yaml) {
  const ParameterReader reader = test::readerOf(yaml, "gains");
  makeLaw(reader, test::pelican());
  reader.finish();
}

/// Refused when `from` in the law's file becomes `to`.
void expectRefused(const std::string& law, const std::string& from, const std::string& to,
                   const std::vector<std::string>& parts) {
  expectRefusal([&] { make(replaced(textOf(law), from, to)); }, parts);
}

TEST(ControllerFactory, MakesEveryLawFromItsFile) {
  const std::vector<std::string> names = lawNames();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const char* law : {"asmc", "geometric", "smc"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), law), 1) << law;
  }
  for (const std::string& name : names) {
    EXPECT_NE(test::lawNamed(name, test::pelican()), nullptr) << name;
  }
}

TEST(ControllerFactory, RefusesUnknownLaws) {
  expectRefused("asmc", "law: asmc", "law: magic",
                {"'gains/law'", "'magic'", "one of asmc, composite, geometric, integral, l1, smc"});
  expectRefused("asmc", "law: asmc", "", {"'gains/law'", "missing"});
  expectRefused("asmc", "law: asmc", "law: [asmc]", {"'gains/law'", "a text"});
}

TEST(ControllerFactory, RefusesTiltLimitsOutOfRange) {
  for (const char* law : {"asmc", "smc", "geometric"}) {
    for (const char* value : {"0", "89.1", "90", "-5", ".nan"}) {
      expectRefused(law, "max_tilt_deg: 80.0", std::string("max_tilt_deg: ") + value,
                    {"'gains/max_tilt_deg'", value, "> 0 and <= 89"});
    }
    expectRefused(law, "min_lift: 2.0", "min_lift: 0", {"'gains/min_lift'", "'0'", "> 0"});
    expectRefused(law, "min_lift: 2.0", "min_lfit: 2.0", {"'gains/min_lift'", "missing"});
    expectRefused(law, "min_lift: 2.0", "min_lift: 2.0\ngain: 1", {"'gains/gain'", "unknown"});
  }
}

TEST(ControllerFactory, RefusesGainsOfTheAsmcThatMakeNoSense) {
  expectRefused("asmc", "slope: [1.2, 1.2, 0.8]", "slope: [1.2, 1.2, -0.8]",
                {"'gains/position/slope'", "-0.8", "positive definite"});
  expectRefused("asmc", "gain: [2.4, 2.4, 16.0]", "gain: [2.4, 2.4, .inf]",
                {"'gains/position/gain[2]'", "'.inf'", "finite"});
  expectRefused("asmc", "gain: [2.4, 2.4, 16.0]", "gain: [2.4, 2.4]",
                {"'gains/position/gain'", "2 numbers"});
  expectRefused("asmc", "boundary_layer: 0.1", "boundary_layer: 0",
                {"'gains/position/boundary_layer'", "'0'", "> 0"});
  expectRefused("asmc", "leak: [3.0, 3.0]", "leak: [3.0, 0]",
                {"'gains/position/leak[1]'", "'0'", "> 0"});
  expectRefused("asmc", "leak: [3.0, 3.0]", "leak: [3.0, 3.0, 3.0]",
                {"'gains/position/leak'", "[3.0, 3.0, 3.0]", "2 numbers"});
  expectRefused("asmc", "initial_gains: [0.01, 0.01]", "initial_gains: [0.01, -0.01]",
                {"'gains/position/initial_gains[1]'", "'-0.01'", "> 0"});
  expectRefused("asmc", "leak: 0.1", "leak: -0.1", {"'gains/mass_estimate/leak'", "'-0.1'"});
  expectRefused("asmc", "initial: 0.01", "initial: .nan",
                {"'gains/mass_estimate/initial'", "'.nan'"});
  expectRefused("asmc", "leak: [50.0, 50.0, 50.0]", "leak: [50.0, 50.0]",
                {"'gains/attitude/leak'", "3 numbers"});
  expectRefused("asmc", "mass_estimate:", "mass_guess:", {"'gains/mass_estimate'", "missing"});
}

TEST(ControllerFactory, RefusesGainsOfTheSmcThatMakeNoSense) {
  expectRefused("smc", "slope: [3.0, 3.0, 3.0]", "slope: [3.0, 0, 3.0]",
                {"'gains/position/slope[1]'", "'0'", "> 0"});
  expectRefused("smc", "nominal: [2.0, 2.0, 2.0]", "nominal: 2.0",
                {"'gains/position/nominal'", "'2.0'", "3 numbers"});
  expectRefused("smc", "payload_bound: [0.4, 0.4, 0.4]", "payload_bound: [0.4, 0.4, -1]",
                {"'gains/position/payload_bound[2]'", "'-1'", ">= 0"});
  EXPECT_NO_THROW(
      make(replaced(textOf("smc"), "payload_bound: [0.4, 0.4, 0.4]", "payload_bound: [0, 0, 0]")));
}

TEST(ControllerFactory, RefusesGainsOfTheGeometricLawThatMakeNoSense) {
  for (const std::string key : {"position_gain", "velocity_gain", "attitude_gain", "rate_gain"}) {
    expectRefused("geometric", key + ": [", key + ": [-1, 0, 0] # [",
                  {"'gains/" + key + "[0]'", "'-1'", "> 0"});
  }
}

TEST(ControllerFactory, NamesTheFileInItsErrors) {
  expectRefusal([] { loadLaw("/nowhere.yaml", test::pelican()); },
                {"'/nowhere.yaml'", "cannot be read"});
}

TEST(ControllerFactory, RefusesUnknownNamesInAFile) {
  const std::string path = test::written("law", textOf("asmc") + "gian: 1\n");
  expectRefusal([&] { loadLaw(path, test::pelican()); }, {path + "/gian'", "unknown"});
}

}  // namespace
}  // namespace aqc

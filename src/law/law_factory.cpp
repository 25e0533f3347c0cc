#include "adaptive_quadrotor_control/law/law_factory.h"

#include <map>
#include <type_traits>
#include <utility>

#include "adaptive_quadrotor_control/law/asmc.h"
#include "adaptive_quadrotor_control/law/composite/composite.h"
#include "adaptive_quadrotor_control/law/geometric.h"
#include "adaptive_quadrotor_control/law/integral.h"
#include "adaptive_quadrotor_control/law/l1.h"
#include "adaptive_quadrotor_control/law/smc.h"
#include "adaptive_quadrotor_control/law/switched/switched.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {
namespace {

using Maker = std::unique_ptr<ControlLaw> (*)(const ParameterReader&, const Vehicle&);

// By a constructor that takes what it needs: the parameters, and the vehicle if it must know it.
template <class Law>
std::pair<const std::string, Maker> entry() {
  return {Law::kName,
          [](const ParameterReader& reader, const Vehicle& vehicle) -> std::unique_ptr<ControlLaw> {
            static_cast<void>(vehicle);
            if constexpr (std::is_constructible_v<Law, const ParameterReader&, const Vehicle&>) {
              return std::make_unique<Law>(reader, vehicle);
            } else {
              return std::make_unique<Law>(reader);
            }
          }};
}

// To add a law: write its class in a file of its own and add its line here.
const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table = {
      entry<Asmc>(), entry<Composite>(), entry<Geometric>(), entry<Integral>(),
      entry<L1>(),   entry<Smc>(),       entry<Switched>(),
  };
  return table;
}

}  // namespace

std::vector<std::string> lawNames() {
  std::vector<std::string> names;
  for (const auto& entry : makers()) names.push_back(entry.first);
  return names;
}

std::unique_ptr<ControlLaw> makeLaw(const ParameterReader& reader, const Vehicle& vehicle) {
  return makers().at(reader.choice("law", lawNames()))(reader, vehicle);
}

std::unique_ptr<ControlLaw> loadLaw(const std::string& path, const Vehicle& vehicle) {
  const ParameterReader reader(loadYamlFile(path), path);
  std::unique_ptr<ControlLaw> controller = makeLaw(reader, vehicle);
  reader.finish();
  return controller;
}

}  // namespace aqc

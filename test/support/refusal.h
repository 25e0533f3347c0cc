#pragma once

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc::test {

/// The message of the Error that `act` throws; empty if it throws none.
template <typename Error = std::invalid_argument, typename Act>
std::string refusal(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Fails unless `act` throws a ParameterError whose message holds all of `parts`.
template <typename Act>
void expectRefusal(const Act& act, const std::vector<std::string>& parts) {
  const std::string message = refusal<ParameterError>(act);
  if (message.empty()) {
    ADD_FAILURE() << "not refused; expected: " << parts.front();
    return;
  }
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
  }
}

inline ParameterReader readerOf(const std::string& yaml, const std::string& name) {
  return ParameterReader(YAML::Load(yaml), name);
}

/// The path of a file with that text in the folder of temporary files.
inline std::string written(const std::string& name, const std::string& text) {
  const std::string path = ::testing::TempDir() + "aqc_" + name + ".yaml";
  std::ofstream(path) << text;
  return path;
}

/// `text` with the first `from` replaced by `to`; fails when there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

}  // namespace aqc::test

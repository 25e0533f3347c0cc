#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace aqc {

/// The numbers that a parameter may take. Not-a-number and infinities are never allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool exclusive_min = false;

  /// Every finite number.
  static Range any() { return {}; }
  /// > 0
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
  /// >= 0
  static Range nonNegative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }
  /// [low, high]
  static Range between(double low, double high) { return {low, high, false}; }
  /// (0, high]
  static Range positiveUpTo(double high) { return {0.0, high, true}; }

  /// False for not-a-number and infinities, whatever the bounds.
  bool contains(double value) const;
  /// "a finite number > 0", as an error message says it.
  std::string text() const;
};

/// The key of a parameter with what a person should know of it. A bare key will do; whatever is to
/// be tuned says more: {"slope", "Phi_p", "1/s", "how fast the error decays"}.
struct ParameterKey {
  // Implicit, so that a text is a key.
  ParameterKey(const char* key_name) : name(key_name) {}
  ParameterKey(std::string key_name) : name(std::move(key_name)) {}
  ParameterKey(std::string key_name, std::string its_symbol, std::string its_unit,
               std::string its_description, std::vector<std::string> its_entries = {})
      : name(std::move(key_name)),
        symbol(std::move(its_symbol)),
        unit(std::move(its_unit)),
        description(std::move(its_description)),
        entries(std::move(its_entries)) {}

  std::string name;
  std::string symbol;                ///< as the literature writes it; empty: none
  std::string unit;                  ///< of the number in the file; empty: none
  std::string description;           ///< a few words, without a full stop
  std::vector<std::string> entries;  ///< what the entries of a list are called: see Parameter
};

/// A parameter as a getter of ParameterReader asked for it, and what it found.
struct Parameter {
  enum class Kind { kNumber, kInteger, kFlag, kText, kNumbers, kTexts };

  /// `key.name` is the path from the outermost map on: "subsystems[0]/leak". `key.entries` are as
  /// many as `numbers` where there is a list of these: the names that the getter gave, when it gave
  /// as many, otherwise the indices from 0.
  ParameterKey key;
  Kind kind = Kind::kNumber;
  Range range;                       ///< of each number
  std::vector<double> numbers;       ///< one unless there is a list of them; a flag is 0 or 1
  std::vector<std::string> texts;    ///< one unless there is a list of them
  std::vector<std::string> choices;  ///< the texts that are allowed; empty: all

  /// What a person should know: "Phi_p [1/s]: how fast the error decays".
  std::string text() const;
};

/// Everything that was read, in the order of reading, each parameter once.
using Schema = std::vector<Parameter>;

}  // namespace aqc

#pragma once

#include <functional>

namespace aqc {

/// What main() of the program `name` returns after `run()`: 0, or 1 when it threw, or when standard
/// output could not be written, which is then said in one line on standard error.
int runProgram(const char* name, const std::function<void()>& run) noexcept;

}  // namespace aqc

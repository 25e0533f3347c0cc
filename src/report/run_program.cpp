#include "report/run_program.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

namespace aqc {
namespace {

// Errors of libraries may run over several lines.
std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

int runProgram(const char* name, const std::function<void()>& run) noexcept {
  try {
    run();
    if (!std::cout.flush()) throw std::runtime_error("cannot write to standard output");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << oneLine(error.what()) << std::endl;
    return 1;
  }
}

}  // namespace aqc

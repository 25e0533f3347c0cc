#pragma once

#include <string>

#include "report/recording.h"

namespace aqc {

/// The flight in a bag: controller/state, plant/status and controller/parameters, in whatever
/// namespace they are. Its time begins at 0 with the mission, as in the CSV files of fly, or with
/// the first step that flies where no mission did. Throws std::runtime_error, naming the file and
/// what is missing in it.
Recording readBag(const std::string& path);

}  // namespace aqc

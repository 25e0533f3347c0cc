#pragma once

namespace aqc {

/// Most subsystems that a law with subsystems may have; they count from 1.
constexpr int kMaxSubsystems = 8;

}  // namespace aqc

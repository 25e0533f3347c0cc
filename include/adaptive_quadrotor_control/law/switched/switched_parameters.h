#pragma once

#include <vector>

#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"
#include "adaptive_quadrotor_control/law/switched/switched_law.h"

namespace aqc {

class ParameterReader;

/// What config/controller/switched.yaml says, validated. All throw ParameterError with the full
/// name, the value and what is allowed.

/// The law with `most` subsystems at most.
SwitchedLaw readSwitchedLaw(const ParameterReader& reader, int most);

/// The switching signal of that law: its dwell time, its policy, where it starts.
SubsystemSwitch readSubsystemSwitch(const ParameterReader& reader, const SwitchedLaw& law);

}  // namespace aqc

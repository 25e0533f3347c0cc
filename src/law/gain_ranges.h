#pragma once

#include "adaptive_quadrotor_control/parameters/schema.h"

namespace aqc {

// What gains may be: any that a multirotor of 500 kg could ask for, at least twenty times what
// those of config/ have. They tell typing mistakes and absurd requests from gains; whether a
// vehicle flies with them is another question: unstableAxis() of pilot/attitude_loop.h asks it of
// gains that are to be taken over in flight.

/// A rate [1/s]: how fast an error decays, or a gain forgets. No rotor follows in a millisecond.
inline const Range kDecay = Range::positiveUpTo(1e4);
/// A force or a moment, or one per error, per rate or per norm of these [N, N m, N/m, N s/m ...]:
/// twenty times the weight of 500 kg.
inline const Range kPush = Range::positiveUpTo(1e5);
/// A boundary layer [m/s], [rad/s].
inline const Range kLayer = Range::positiveUpTo(100.0);
/// A mass [kg] or a moment of inertia [kg m^2] as a law is told it, or learns it.
inline const Range kMatter = Range::positiveUpTo(1e4);

}  // namespace aqc

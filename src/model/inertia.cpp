#include "adaptive_quadrotor_control/model/inertia.h"

#include "adaptive_quadrotor_control/math/eigenvalues.h"
#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {

Eigen::Matrix3d readInertia(const ParameterReader& reader, double least) {
  constexpr double kMost = 1e5;
  constexpr double kTolerated = 1.5;
  const Eigen::Matrix3d inertia = reader.positiveDefinite("inertia", kMost);
  const EigenvalueRange moments = eigenvalueRange(inertia);
  if (moments.min < least) {
    reader.refuse("inertia", "is " + reader.valueText("inertia") +
                                 ", whose smallest principal moment is " + numberText(moments.min) +
                                 "; it must be >= " + numberText(least));
  }
  const double others = inertia.trace() - moments.max;
  if (moments.max > kTolerated * others) {
    reader.refuseValue("inertia",
                       "a rigid body's, where no moment exceeds the other two together; the "
                       "largest is " +
                           numberText(moments.max / others) + " times these (up to " +
                           numberText(kTolerated) + " is let pass)");
  }
  return inertia;
}

}  // namespace aqc

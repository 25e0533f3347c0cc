#include "adaptive_quadrotor_control/simulation/payload.h"

#include "adaptive_quadrotor_control/model/inertia.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {

Eigen::Matrix3d boxInertia(double mass, const Eigen::Vector3d& size) {
  const Eigen::Vector3d squares = size.cwiseAbs2();
  return mass / 12.0 *
         (Eigen::Vector3d::Constant(squares.sum()) - squares).asDiagonal().toDenseMatrix();
}

Payload readPayload(const ParameterReader& reader) {
  Payload payload;
  payload.mass = reader.number("mass", Range::positiveUpTo(1e3));
  payload.size = reader.vector3("size", Range::positiveUpTo(10.0));
  payload.offset = reader.vector3("offset", Range::between(-10.0, 10.0));
  payload.inertia =
      reader.has("inertia") ? readInertia(reader) : boxInertia(payload.mass, payload.size);
  return payload;
}

}  // namespace aqc

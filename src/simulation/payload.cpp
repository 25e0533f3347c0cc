#include "adaptive_quadrotor_control/simulation/payload.h"

#include "adaptive_quadrotor_control/model/inertia.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {

namespace {

const Range kJointFrequency = Range::between(0.1, 200.0);
const Range kJointDamping = Range::between(0.0, 2.0);
const Range kCableLength = Range::between(0.05, 100.0);

void readMount(const ParameterReader& reader, Payload& payload) {
  if (reader.has("joint")) {
    const ParameterReader joint = reader.child("joint");
    payload.mount =
        Joint{joint.number("frequency", kJointFrequency), joint.number("damping", kJointDamping)};
  }
  if (!reader.has("cable")) return;
  if (!payload.rigid()) {
    reader.refuse("cable", "is there beside 'joint'; a payload hangs on one of them");
  }
  payload.mount = Cable{reader.child("cable").number("length", kCableLength)};
}

}  // namespace

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
  readMount(reader, payload);
  return payload;
}

}  // namespace aqc

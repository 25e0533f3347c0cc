#include "ros/controller/frames.h"

#include <tf2/exceptions.h>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "ros/border/conversions.h"

namespace aqc {

std::optional<Eigen::Isometry3d> Frames::toWorld(const std::string& frame) {
  if (isWorld(frame)) return Eigen::Isometry3d::Identity();
  return transform(names_.world, frame);
}

std::optional<Eigen::Isometry3d> Frames::bodyIn(const std::string& frame) {
  if (isBody(frame)) return Eigen::Isometry3d::Identity();
  return transform(frame, names_.body);
}

std::optional<Eigen::Isometry3d> Frames::transform(const std::string& target,
                                                   const std::string& source) {
  geometry_msgs::TransformStamped found;
  try {
    found = buffer_.lookupTransform(target, source, ros::Time(0));
  } catch (const tf2::TransformException& error) {
    why_ = "tf2 cannot tell '" + source + "' in '" + target + "': " + error.what();
    return std::nullopt;
  }
  const double age = (ros::Time::now() - found.header.stamp).toSec();
  if (!found.header.stamp.isZero() && age > kOldest) {
    why_ = "the transform of '" + source + "' in '" + target + "' is " + numberText(age) +
           " s old; at most " + numberText(kOldest) + " s are allowed";
    return std::nullopt;
  }
  return Eigen::Translation3d(toEigen(found.transform.translation)) *
         toEigen(found.transform.rotation).normalized();
}

}  // namespace aqc

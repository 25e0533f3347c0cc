#include "ros/controller/guard_services.h"

#include <std_srvs/Trigger.h>

#include <functional>

#include "adaptive_quadrotor_control/GoTo.h"
#include "ros/border/conversions.h"
#include "ros/border/names.h"

namespace aqc {
namespace {

template <class Response>
void answer(const char* obstacle, Response& response) {
  response.success = obstacle == nullptr;
  if (obstacle != nullptr) response.message = obstacle;
}

}  // namespace

GuardServices::GuardServices(ros::NodeHandle node, Pilot& pilot) {
  Guard& guard = *pilot.guard();
  const auto serve = [&](const std::string& name, const std::function<const char*()>& obey) {
    using Callback =
        boost::function<bool(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)>;
    const Callback callback = [name, obey](std_srvs::Trigger::Request&,
                                           std_srvs::Trigger::Response& response) {
      answer(obey(), response);
      if (response.success) {
        ROS_INFO("%s", name.c_str());
      } else {
        ROS_WARN("no %s: %s", name.c_str(), response.message.c_str());
      }
      return true;
    };
    services_.push_back(node.advertiseService(name, callback));
  };
  serve("arm", [&guard] { return guard.arm(); });
  serve("disarm", [&guard] { return guard.disarm(); });
  serve("take_off", [&guard] { return guard.takeOff(); });
  serve("land", [&guard] { return guard.land(); });
  serve("hold", [&guard] { return guard.hold(); });
  serve("release", [&pilot]() -> const char* {
    pilot.release();
    return nullptr;
  });
  serve("kill", [&guard]() -> const char* {
    guard.kill();
    return nullptr;
  });
  using GoToCallback = boost::function<bool(msgs::GoTo::Request&, msgs::GoTo::Response&)>;
  const GoToCallback go_to = [&guard](msgs::GoTo::Request& request,
                                      msgs::GoTo::Response& response) {
    SetPoint place;
    place.position = toEigen(request.position);
    place.yaw = request.yaw;
    answer(guard.goTo(place), response);
    return true;
  };
  services_.push_back(node.advertiseService("go_to", go_to));
}

}  // namespace aqc

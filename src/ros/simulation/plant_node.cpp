#include "ros/simulation/plant_node.h"

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Imu.h>

#include <cmath>

#include "adaptive_quadrotor_control/PlantStatus.h"
#include "ros/border/conversions.h"
#include "ros/border/names.h"
#include "ros/border/parameter_tree.h"
#include "ros/border/run_node.h"

namespace aqc {
namespace {

// The simulated clock begins here: ROS takes zero for "no time yet".
constexpr Nanoseconds kClockStart = 1'000'000'000;

// Of the payload's centre from the vehicle's origin, in B [m]; it may swing.
Eigen::Vector3d payloadOffset(const Plant& plant) {
  if (plant.payload()->rigid()) return plant.payload()->offset;
  const State state = plant.state();
  return state.attitude.conjugate() * (plant.payloadMotion().position - state.position);
}

// In lock step the clock stands still until a command comes; where it races, messages are no faster
// for it. The scenario knows better.
Nanoseconds defaultCommandTimeout(const World& world, const Pacer::Pace& pace) {
  const Nanoseconds usual = fromSeconds(0.25 * std::max(1.0, pace.real_time_factor));
  return world.command_timeout.value_or(pace.lock_step ? 0
                                                       : std::max(usual, 2 * world.control_period));
}

// Periods without odometry that pass at once in lock step; other callbacks come in between.
constexpr int kMostUntold = 100;

// For a service callback to return: it was called in order, and the answer is no.
template <class Response>
bool refuse(Response& response, const std::string& reason) {
  response.success = false;
  response.message = reason;
  return true;
}

}  // namespace

PlantNode::PlantNode()
    : vehicle_(readParameters(node_, "vehicle", readVehicle)),
      world_(readParameters(node_, "scenario", readWorldAlone)) {
  const ParameterReader own = parameterReader(private_node_, "");
  Pacer::Pace pace;
  pace.period = world_.control_period;
  pace.lock_step = own.flag("lock_step", false);
  pace.real_time_factor = own.number("real_time_factor", Range::positiveUpTo(1000.0), 1.0);
  pace.paused = own.flag("start_paused", false);
  command_timeout_ = own.has("command_timeout") ? readCommandTimeout(own, world_.control_period)
                                                : defaultCommandTimeout(world_, pace);
  own.finish();
  simulated_time_ = node_.param("/use_sim_time", false);
  if (pace.lock_step && !simulated_time_) own.refuse("lock_step", "needs /use_sim_time to be true");
  if (pace.real_time_factor != 1.0 && !simulated_time_) {
    own.refuse("real_time_factor", "other than 1 needs /use_sim_time to be true");
  }

  odometry_publisher_ = node_.advertise<nav_msgs::Odometry>(kOdometryTopic, 100);
  imu_publisher_ = node_.advertise<sensor_msgs::Imu>(kImuTopic, 100);
  status_publisher_ = private_node_.advertise<msgs::PlantStatus>("status", 10000);
  if (simulated_time_) clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 1000);
  const Nanoseconds start = simulated_time_ ? kClockStart : toNanoseconds(ros::Time::now());
  pacer_.emplace(pace, steadyNow(), start);
  restart(start);

  command_subscriber_ = node_.subscribe(kMotorSpeedTopic, 100, &PlantNode::onCommand, this,
                                        ros::TransportHints().tcpNoDelay());
  services_ = {serve<AttachPayload>(),
               serve<DetachPayload>(),
               serve<SetWind>(),
               serve<SetBody>(),
               serve<ApplyDisturbance>(),
               serve<SetRotor>(),
               serve<SetBattery>(),
               serve<SetGust>(),
               serve<LoseCommands>(),
               private_node_.advertiseService("reset", &PlantNode::onReset, this),
               private_node_.advertiseService("resume", &PlantNode::onResume, this)};
  timer_ = node_.createSteadyTimer(ros::WallDuration(toSeconds(pacer_->interval())),
                                   &PlantNode::onSteadyTimer, this);
  publish();
}

void PlantNode::restart(Nanoseconds start) {
  plant_ = std::make_unique<TimedPlant>(makePlant(vehicle_, world_), world_.cargo,
                                        world_.plant_step, start, command_timeout_);
  channels_.reset();
  if (world_.sensors) channels_.emplace(*world_.sensors, start);
  was_silent_ = false;
  pacer_->restart(steadyNow(), start);
}

void PlantNode::onCommand(const msgs::Actuators::ConstPtr& message) {
  const std::size_t rotors = vehicle_.rotors.size();
  if (message->angular_velocities.size() != rotors) {
    ROS_WARN_THROTTLE(1.0, "motor command dropped: it has %zu speeds, the vehicle %zu rotors",
                      message->angular_velocities.size(), rotors);
    return;
  }
  const Nanoseconds answers = channels_ ? told_ : plant_->now();
  if (!pacer_->takes(toNanoseconds(message->header.stamp), answers)) return;
  plant_->command(Eigen::Map<const Eigen::VectorXd>(message->angular_velocities.data(),
                                                    static_cast<Eigen::Index>(rotors)));
  if (pacer_->lockStep()) advanceToAnswer();
}

// In lock step to the next odometry, which will be answered.
void PlantNode::advanceToAnswer() {
  for (int i = 0; i < kMostUntold; ++i) {
    advance();
    if (tells_) return;
  }
}

void PlantNode::onSteadyTimer(const ros::SteadyTimerEvent&) {
  const Nanoseconds now = steadyNow();
  if (pacer_->repeats(now)) {
    if (channels_ && !pacer_->paused()) {
      advanceToAnswer();
    } else {
      publish();
    }
  }
  for (int due = pacer_->due(now, plant_->now()); due > 0; --due) advance();
}

void PlantNode::advance() {
  const Nanoseconds until = plant_->now() + world_.control_period;
  tells_ = false;
  if (channels_) {
    SensorChannels::advance(*plant_, world_.plant_step, until, [this] { listen(); });
  } else {
    plant_->advance(until);
  }
  if (plant_->silent() && !was_silent_) {
    ROS_WARN("no motor command for %.3g s: the rotors are switched off until one comes",
             toSeconds(command_timeout_));
  }
  was_silent_ = plant_->silent();
  publish();
}

void PlantNode::publish() {
  pacer_->published(steadyNow());
  const Nanoseconds time = plant_->now() - (pacer_->paused() ? world_.control_period : 0);
  const ros::Time stamp = toRosTime(time);
  if (simulated_time_) {
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    clock_publisher_.publish(clock);
  }
  publishTruth(toRosTime(plant_->now()));

  if (stamp != transform_stamp_) publishTransforms(stamp);  // tf complains about repetitions
  if (channels_ && !pacer_->paused()) {
    listen();
  } else {
    const State& state = plant_->plant().state();
    publishImu({plant_->plant().specificForce(), state.body_rate, time, time});
    publishOdometry({state, time, time});  // last: in lock step the answer moves on
  }
}

// Whatever the sensors measure, and what has arrived of it, at this instant.
void PlantNode::listen() {
  channels_->listen(
      *plant_, [this](const ImuMessage& message) { publishImu(message); },
      [this](const OdometryMessage& message) { publishOdometry(message); });
}

void PlantNode::publishImu(const ImuMessage& message) {
  sensor_msgs::Imu imu;
  imu.header.stamp = toRosTime(message.stamp);
  imu.header.frame_id = kBodyFrame;
  imu.orientation = toQuaternion(plant_->plant().state().attitude);
  imu.angular_velocity = toVector3(message.body_rate);
  imu.linear_acceleration = toVector3(message.specific_force);
  imu_publisher_.publish(imu);
}

void PlantNode::publishOdometry(const OdometryMessage& message) {
  told_ = message.stamp;
  tells_ = true;
  odometry_publisher_.publish(toOdometry(message.state, message.stamp));
}

void PlantNode::publishTransforms(const ros::Time& stamp) {
  transform_stamp_ = stamp;
  const State& state = plant_->plant().state();
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = kWorldFrame;
  transform.child_frame_id = kBodyFrame;
  transform.transform.translation = toVector3(state.position);
  transform.transform.rotation = toQuaternion(state.attitude);
  transforms_.sendTransform(transform);
  if (plant_->plant().payload()) {
    transform.header.frame_id = kBodyFrame;
    transform.child_frame_id = "payload";
    transform.transform.translation = toVector3(payloadOffset(plant_->plant()));
    transform.transform.rotation = toQuaternion(Eigen::Quaterniond::Identity());
    transforms_.sendTransform(transform);
  }
}

void PlantNode::publishTruth(const ros::Time& stamp) {
  const Plant& plant = plant_->plant();
  msgs::PlantStatus status;
  status.header.stamp = stamp;
  status.paused = pacer_->paused();
  status.touching = plant.touching();
  status.commands_timed_out = plant_->silent();
  status.crashed = plant_->crashTime().has_value();
  status.crash_reason = toString(plant.crash());
  if (status.crashed) status.crash_time = toRosTime(*plant_->crashTime());
  status.payload_mass = plant.payloadMass();
  const ForceMoment disturbance = plant_->disturbance();
  status.disturbance_force = toVector3(disturbance.force);
  status.disturbance_moment = toVector3(disturbance.moment);
  status.rotor_speeds.assign(plant.rotorSpeeds().begin(), plant.rotorSpeeds().end());
  for (const RotorCondition& rotor : plant_->rotors()) {
    status.rotor_effectiveness.push_back(rotor.effectiveness);
    status.rotor_stuck.push_back(rotor.stuck_at.has_value());
    status.rotor_stuck_at.push_back(rotor.stuck_at.value_or(0.0));
    status.rotor_slower.push_back(rotor.slower);
  }
  status.battery_voltage = plant_->battery();
  if (const auto& payload = plant.payload()) {
    status.payload_name = plant_->attachedName();
    status.payload_size = toVector3(payload->size);
    status.payload_offset = toVector3(payloadOffset(plant));
  }
  for (const Cargo& cargo : plant_->cargo()) {
    status.cargo_names.push_back(cargo.name);
    status.cargo_positions.push_back(toPoint(cargo.position));
    status.cargo_sizes.push_back(toVector3(cargo.payload.size));
  }
  status.wind = toVector3(plant_->wind());
  status_publisher_.publish(status);
}

template <class Action>
ros::ServiceServer PlantNode::serve() {
  using Service = typename PlantService<Action>::Type;
  const boost::function<bool(typename Service::Request&, typename Service::Response&)> answer =
      [this](const auto& request, auto& response) {
        try {
          const Nanoseconds time = std::max(toNanoseconds(request.at), plant_->now());
          plant_->schedule({time, requested(request)});
          response.success = true;
          return true;
        } catch (const std::exception& error) {
          return refuse(response, error.what());
        }
      };
  return private_node_.advertiseService(PlantService<Action>::kName, answer);
}

AttachPayload PlantNode::requested(const msgs::AttachPayload::Request& request) const {
  // Of a payload that lies there the name is enough.
  const bool known = plant_->knows(request.name);
  AttachPayload attach = known ? AttachPayload{request.name, {}} : toAction(request);
  const bool now = toNanoseconds(request.at) <= plant_->now();
  const std::string obstacle = now ? plant_->obstacle(attach) : "";
  if (!obstacle.empty()) throw std::logic_error(obstacle);
  return attach;
}

template <class Request>
auto PlantNode::requested(const Request& request) const {
  return toAction(request);
}

bool PlantNode::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  restart(plant_->now());  // the clock goes on: ROS time must not jump back
  response.success = true;
  publish();
  return true;
}

bool PlantNode::onResume(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.success = pacer_->resume(steadyNow(), plant_->now());
  if (!response.success) {
    response.message = "the simulation is running already";
    return true;
  }
  publish();
  return true;
}

}  // namespace aqc

int main(int argc, char** argv) {
  return aqc::spinNode<aqc::PlantNode>(argc, argv, "plant");
}

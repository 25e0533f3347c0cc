#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "fuzz/bytes.h"
#include "fuzz/range.h"
#include "fuzz/shipped.h"
#include "fuzz/targets.h"

namespace aqc::fuzz {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;
constexpr Nanoseconds kStart = 1'000'000'000'000;
constexpr Nanoseconds kLastStamp = 4'294'967'295'999'999'999;  // that a ros::Time can say
constexpr int kMostEvents = 200;
constexpr int kMostPeriods = 1250;
constexpr std::array<const char*, 4> kLaws = {"asmc", "smc", "geometric", "switched"};

constexpr const char* kTooLight = "lifter_lag";  // to stand on the ground with steps of 1 ms

// A plant and a pilot that hears of it, and of much else.
class EventFlight {
 public:
  EventFlight(const std::string& law, const std::string& vehicle, std::uint8_t options)
      : vehicle_name_(vehicle),
        vehicle_(shippedVehicle(vehicle)),
        plant_(vehicle_, start(options), {}, vehicle != kTooLight),
        pilot_(vehicle_, shippedLaw(law, vehicle), kPeriod,
               (options & 2u) != 0 ? StepClock::Trigger::kTimer : StepClock::Trigger::kOdometry,
               limits(options)) {
    if (guard() != nullptr && (options & 8u) != 0) guard()->wasArmed();
  }

  // What is wrong after one more event.
  std::string next(Bytes& bytes) {
    stepped_ = false;
    switch (bytes.choice(14)) {
      case 0:
        return fly(bytes.byte());
      case 1:
        sayOdometry(bytes);
        break;
      case 2:
        sayImu(bytes);
        break;
      case 3:
        pilot_.hear(vector(bytes, 30.0), stamp(bytes));
        break;
      case 4:
        plan(bytes, 1);
        break;
      case 5:
        plan(bytes, bytes.choice(8));
        break;
      case 6:
        order(bytes);
        break;
      case 7:
        tick();
        break;
      case 8:
        heard(pilot_.watch(now_));
        break;
      case 9:
        now_ = stamp(bytes);
        break;
      case 10:
        pilot_.order({stamp(bytes), static_cast<int>(bytes.word(4))});
        break;
      case 11:
        handOver(bytes);
        break;
      case 12:
        silence_ = bytes.byte();
        break;
      default:
        judge(bytes);
    }
    return finding();
  }

 private:
  Guard* guard() { return pilot_.guard(); }

  static State start(std::uint8_t options) {
    State state;
    state.position.z() = (options & 8u) != 0 ? 2.0 : 0.1;
    return state;
  }
  static PilotLimits limits(std::uint8_t options) {
    PilotLimits limits;
    if ((options & 1u) == 0) return limits;
    limits.guard = GuardLimits();
    limits.guard->auto_arm = (options & 4u) != 0;
    return limits;
  }
  static Eigen::Vector3d vector(Bytes& bytes, double usual) {
    const double x = bytes.number(usual);
    const double y = bytes.number(usual);
    return {x, y, bytes.number(usual)};
  }
  // Of now, mostly.
  Nanoseconds stamp(Bytes& bytes) const {
    const std::uint8_t kind = bytes.byte();
    if (kind < 128) return now_;
    const Nanoseconds step = static_cast<Nanoseconds>(bytes.word(2)) * 100'000;
    const Nanoseconds later = kind < 160   ? now_ + step
                              : kind < 192 ? now_ - step
                              : kind < 224 ? now_ - 100 * step
                                           : static_cast<Nanoseconds>(bytes.word(8) >> 1u);
    return std::clamp<Nanoseconds>(later, 0, kLastStamp);
  }

  void heard(Publish publish) { stepped_ = stepped_ || publish == Publish::kNewCommand; }
  void tick() { heard(pilot_.tick(now_)); }

  // Periods in which all is as it should be, but for what is silent.
  std::string fly(int periods) {
    for (; periods > 0 && periods_ < kMostPeriods; --periods, ++periods_) {
      const State state = plant_.state();
      if ((silence_ & 1u) == 0) {
        heard(pilot_.hear(plant_.specificForce(), state.body_rate, now_).publish);
      }
      if ((silence_ & 2u) == 0) heard(pilot_.hear(state, now_, now_).publish);
      if (pilot_.stepClock().trigger() == StepClock::Trigger::kTimer) {
        tick();
      } else {
        heard(pilot_.watch(now_));
      }
      for (int i = 0; i < 4; ++i) plant_.step(pilot_.allocation().speeds, 1e-3);
      now_ = std::min(now_ + kPeriod, kLastStamp);
      std::string finding = this->finding();
      if (!finding.empty()) return finding;
    }
    return "";
  }
  void sayOdometry(Bytes& bytes) {
    State state = plant_.state();
    const std::uint8_t wrong = bytes.byte();
    if ((wrong & 1u) != 0) state.position += vector(bytes, 2.0);
    if ((wrong & 2u) != 0) state.velocity += vector(bytes, 5.0);
    if ((wrong & 4u) != 0) state.attitude.vec() += vector(bytes, 0.5);
    if ((wrong & 8u) != 0) state.attitude.w() = bytes.number(1.0);
    if ((wrong & 16u) != 0) state.body_rate += vector(bytes, 10.0);
    if ((wrong & 32u) != 0) state.attitude.normalize();
    heard(pilot_.hear(state, stamp(bytes), now_).publish);
  }
  void sayImu(Bytes& bytes) {
    const Eigen::Vector3d specific_force = vector(bytes, 30.0);
    const Eigen::Vector3d body_rate = vector(bytes, 10.0);
    heard(pilot_.hear(specific_force, body_rate, stamp(bytes)).publish);
  }
  static SetPoint setPoint(Bytes& bytes) {
    SetPoint point;
    const std::uint8_t said = bytes.byte();
    point.position = vector(bytes, 5.0) + Eigen::Vector3d(0.0, 0.0, 2.0);
    if ((said & 1u) != 0) point.velocity = vector(bytes, 2.0);
    if ((said & 2u) != 0) point.acceleration = vector(bytes, 5.0);
    if ((said & 4u) != 0) point.jerk = vector(bytes, 20.0);
    if ((said & 8u) != 0) point.yaw = bytes.number(4.0);
    if ((said & 16u) != 0) point.yaw_rate = bytes.number(2.0);
    if ((said & 32u) != 0) point.yaw_acceleration = bytes.number(2.0);
    return point;
  }
  void plan(Bytes& bytes, std::size_t count) {
    std::vector<TimedSetPoint> points;
    Nanoseconds time = pilot_.beginning(stamp(bytes), now_);
    for (; count > 0; --count) {
      points.push_back({time, setPoint(bytes)});
      time = std::min(time + static_cast<Nanoseconds>(bytes.word(2)) * 100'000, kLastStamp);
    }
    try {
      pilot_.plan(std::move(points), now_, stamp(bytes));
    } catch (const std::invalid_argument&) {
      pilot_.countRefusedSetPoints();
    }
  }
  void order(Bytes& bytes) {
    const std::size_t which = bytes.choice(8);
    if (which == 0) return pilot_.release();
    if (guard() == nullptr) return;
    switch (which) {
      case 1:
        guard()->arm();
        break;
      case 2:
        guard()->takeOff();
        break;
      case 3:
        guard()->land();
        break;
      case 4:
        guard()->hold();
        break;
      case 5:
        guard()->goTo(setPoint(bytes));
        break;
      case 6:
        guard()->disarm();
        break;
      default:
        guard()->kill();
        killed_ = true;
    }
  }
  void handOver(Bytes& bytes) {
    std::unique_ptr<ControlLaw> law =
        shippedLaw(kLaws.at(bytes.choice(kLaws.size())), vehicle_name_);
    pilot_.handOver(law);
  }
  void judge(Bytes& bytes) {
    pilot_.judge(now_, bytes.number(10.0));
    pilot_.sample();
    pilot_.countRefusedOdometry();
  }

  std::string finding() {
    std::string range = outOfRange(pilot_.allocation().speeds, vehicle_);
    if (!range.empty()) return range;
    const State state = plant_.state();
    if (!state.valid()) return "the plant is nowhere";
    if (guard() == nullptr) return "";
    const Telemetry& telemetry = pilot_.law().telemetry();
    if (!pilot_.law().finite() || !telemetry.adaptive.allFinite()) {
      return std::string("a guarded law is not finite: ") + pilot_.law().name();
    }
    if (!pilot_.sample().set_point.valid()) return "a guarded set point is not finite";
    const Mode mode = guard()->mode();
    if (killed_ && mode != Mode::kKilled) return "killed, but alive";
    const bool still = mode == Mode::kDisarmed || mode == Mode::kKilled;
    if (stepped_ && still && pilot_.allocation().speeds.norm() != 0.0) {
      return "disarmed, but the rotors turn";
    }
    return "";
  }

  std::string vehicle_name_;
  Vehicle vehicle_;
  RigidPlant plant_;
  Pilot pilot_;
  Nanoseconds now_ = kStart;
  int periods_ = 0;
  std::uint8_t silence_ = 0;  // of the IMU, of odometry
  bool stepped_ = false;      // in this event
  bool killed_ = false;
};

}  // namespace

std::string flyEvents(const std::string& input) {
  Bytes bytes(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  const std::uint8_t options = bytes.byte();
  const std::string law = kLaws.at(bytes.choice(kLaws.size()));
  EventFlight flight(law, law == "switched" ? kTooLight : "pelican_thesis", options);
  for (int i = 0; i < kMostEvents && !bytes.empty(); ++i) {
    const std::string finding = flight.next(bytes);
    if (!finding.empty()) return "event " + std::to_string(i) + ": " + finding;
  }
  return "";
}

}  // namespace aqc::fuzz

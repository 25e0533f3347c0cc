#include <Eigen/Core>
#include <cmath>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "campaign/draw.h"

namespace aqc {
namespace {

// Of the odometry all the time.

std::string drawNoise(const Draw& draw) {
  OdometryNoise& noise = draw.odometry().noise;
  noise.position = draw.dice.between(0.0, 0.03);
  noise.velocity = draw.dice.between(0.0, 0.1);
  noise.attitude = draw.dice.between(0.0, 2.0 * kDegree);
  noise.body_rate = draw.dice.between(0.0, 0.1);
  return formatted("%.4f m, %.3f m/s, %.2f deg, %.3f rad/s", noise.position, noise.velocity,
                   noise.attitude / kDegree, noise.body_rate);
}

std::string drawDrift(const Draw& draw) {
  draw.odometry().position_drift = draw.dice.between(0.0, 0.1);
  draw.odometry().yaw_drift = draw.dice.between(0.0, 1.0 * kDegree);
  return formatted("%.3f m, %.2f deg in a second", draw.odometry().position_drift,
                   draw.odometry().yaw_drift / kDegree);
}

std::string drawRate(const Draw& draw) {
  const double rate = draw.dice.between(50.0, 250.0);
  draw.odometry().period = fromSeconds(1.0 / rate);
  return formatted("%.1f Hz", rate);
}

std::string drawTime(const Draw& draw, Nanoseconds& time, double longest) {
  time = fromSeconds(draw.dice.between(0.0, longest));
  return formatted("%.1f ms", toSeconds(time) * 1e3);
}
std::string drawDelay(const Draw& draw) {
  return drawTime(draw, draw.odometry().delay, 0.015);
}
std::string drawJitter(const Draw& draw) {
  return drawTime(draw, draw.odometry().jitter, 0.01);
}

std::string drawShare(const Draw& draw, double& share) {
  share = draw.dice.between(0.0, 0.6);
  return formatted("%.0f %%", 100.0 * share);
}
std::string drawDropped(const Draw& draw) {
  return drawShare(draw, draw.odometry().dropped);
}
std::string drawDuplicated(const Draw& draw) {
  return drawShare(draw, draw.odometry().duplicated);
}
std::string drawReordered(const Draw& draw) {
  return drawShare(draw, draw.odometry().reordered);
}

// Of the odometry for a spell, or from some time on.

std::string drawJump(const Draw& draw) {
  OdometryJump jump;
  jump.window = draw.spell();
  if (draw.dice.chance(0.5)) jump.window.until = TimeWindow().until;
  jump.position = draw.dice.between(0.1, 10.0) * draw.dice.direction();
  if (draw.dice.chance(0.3)) jump.yaw = draw.dice.between(-M_PI, M_PI);
  draw.odometry().jumps.push_back(jump);
  return text(jump.position) + formatted(" m, %.1f deg ", jump.yaw / kDegree) + text(jump.window);
}

std::string drawSpell(const Draw& draw, std::vector<TimeWindow>& spells) {
  spells.push_back(draw.spell());
  return text(spells.back());
}
std::string drawFreeze(const Draw& draw) {
  return drawSpell(draw, draw.odometry().freezes);
}
std::string drawNotANumber(const Draw& draw) {
  return drawSpell(draw, draw.odometry().not_a_number);
}
std::string drawGap(const Draw& draw) {
  return drawSpell(draw, draw.odometry().gaps);
}

std::string drawStamps(const Draw& draw) {
  const StampError error{draw.spell(), fromSeconds(draw.dice.between(-10.0, 10.0))};
  draw.odometry().stamps.push_back(error);
  return formatted("%.3f s ", toSeconds(error.offset)) + text(error.window);
}

std::string drawClockStep(const Draw& draw) {
  StampError error{{fromSeconds(draw.time())}, fromSeconds(draw.dice.between(-100.0, 100.0))};
  if (draw.dice.chance(0.5)) error.offset /= 100;
  draw.odometry().stamps.push_back(error);
  draw.imu().stamps.push_back(error);
  return formatted("%.3f s at %.3f s", toSeconds(error.offset), toSeconds(error.window.from));
}

std::string drawEnd(const Draw& draw, std::vector<TimeWindow>& gaps) {
  gaps.push_back({fromSeconds(draw.time())});
  return formatted("from %.3f s", toSeconds(gaps.back().from));
}
std::string drawNoOdometry(const Draw& draw) {
  return drawEnd(draw, draw.odometry().gaps);
}
std::string drawNoImu(const Draw& draw) {
  return drawEnd(draw, draw.imu().gaps);
}

// Of the IMU all the time.

std::string drawImuNoise(const Draw& draw) {
  draw.imu().force_noise = draw.dice.between(0.0, 0.5);
  draw.imu().rate_noise = draw.dice.between(0.0, 0.03);
  return formatted("%.3f m/s^2, %.4f rad/s", draw.imu().force_noise, draw.imu().rate_noise);
}

std::string drawImuBias(const Draw& draw) {
  draw.imu().force_bias = draw.dice.between(0.0, 0.15) * draw.dice.direction();
  draw.imu().rate_bias = draw.dice.between(0.0, 0.015) * draw.dice.direction();
  return text(draw.imu().force_bias) + " m/s^2, " + text(draw.imu().rate_bias) + " rad/s";
}

}  // namespace

std::vector<FaultDraw> sensorFaults() {
  return {
      {{FaultKind::kNoise, "noise", "odometry: 0.03 m, 0.1 m/s, 2 deg, 0.1 rad/s at the most"},
       drawNoise},
      {{FaultKind::kDrift, "drift", "to 0.1 m and 1 deg in a second, as the root of time"},
       drawDrift},
      {{FaultKind::kRate, "rate", "50 to 250 Hz"}, drawRate},
      {{FaultKind::kDelay, "delay", "to 15 ms"}, drawDelay},
      {{FaultKind::kJitter, "jitter", "to 10 ms"}, drawJitter},
      {{FaultKind::kDropped, "dropped", "to 60 % of the messages"}, drawDropped},
      {{FaultKind::kDuplicated, "duplicated", "to 60 %"}, drawDuplicated},
      {{FaultKind::kReordered, "reordered", "to 60 %"}, drawReordered},
      {{FaultKind::kJump, "jump", "0.1 to 10 m, 3 of 10 turn, too; half of them for ever"},
       drawJump},
      {{FaultKind::kFreeze, "freeze", "0.1 to 5 s"}, drawFreeze},
      {{FaultKind::kNotANumber, "not a number", "0.1 to 5 s"}, drawNotANumber},
      {{FaultKind::kStamps, "stamps", "to 10 s off, 0.1 to 5 s long"}, drawStamps},
      {{FaultKind::kClockStep, "clock step", "to 100 s, half of them to 1 s; IMU, too"},
       drawClockStep},
      {{FaultKind::kGap, "gap", "0.1 to 5 s"}, drawGap},
      {{FaultKind::kNoOdometry, "no odometry", "for ever"}, drawNoOdometry},
      {{FaultKind::kImuNoise, "IMU noise", "to 0.5 m/s^2, 0.03 rad/s"}, drawImuNoise},
      {{FaultKind::kImuBias, "IMU bias", "to 0.15 m/s^2, 0.015 rad/s"}, drawImuBias},
      {{FaultKind::kNoImu, "no IMU", "for ever, never with a fault that silences odometry"},
       drawNoImu},
  };
}

}  // namespace aqc

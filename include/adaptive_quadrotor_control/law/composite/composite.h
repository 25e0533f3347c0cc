#pragma once

#include <array>

#include "adaptive_quadrotor_control/law/adaptive_gain.h"
#include "adaptive_quadrotor_control/law/attitude.h"
#include "adaptive_quadrotor_control/law/composite/applied_wrench.h"
#include "adaptive_quadrotor_control/law/composite/bounded_surface.h"
#include "adaptive_quadrotor_control/law/composite/inertia_estimate.h"
#include "adaptive_quadrotor_control/law/composite/mass_estimate.h"
#include "adaptive_quadrotor_control/law/composite/moment_observer.h"
#include "adaptive_quadrotor_control/law/composite/prediction.h"
#include "adaptive_quadrotor_control/law/composite/thrust_share.h"
#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// Composite adaptive sliding mode: the thesis's two surfaces, of which the outer one never asks
/// for more than the motors brake, and an adaptation that learns from the prediction error as well
/// as from the surface (Slotine and Li 1989). It estimates mass, force, moment and inertia, follows
/// acceleration and jerk, and predicts away the age of what is sensed. docs/composite.md has the
/// equations, what was measured and what it cannot do.
///
/// With an accelerometer it is best; without one, or when it falls silent, it goes on.
class Composite final : public ControlLaw {
 public:
  /// Names and meaning: config/controller/composite.yaml. Throws ParameterError.
  Composite(const ParameterReader& reader, const Vehicle& vehicle);

  Wrench command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept override;
  void observe(const Wrench& given, double dt) noexcept override { applied_.observe(given, dt); }
  void adapt(const Achieved& achieved, double dt) noexcept override;
  /// All but what the rotors do.
  void reset() noexcept override;
  /// From a composite all that it knows; from another law liftedMass().
  void adopt(const ControlLaw& old) noexcept override;
  /// m-hat <= the smaller one of `most_mass` and 0.98 of what the rotors lift.
  void bound(const EstimateBounds& bounds) noexcept override;
  bool finite() const noexcept override;
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<Composite>(*this); }
  const char* name() const noexcept override { return kName; }
  static constexpr const char* kName = "composite";
  bool usesSpecificForce() const noexcept override { return true; }
  bool usesGyroscope() const noexcept override { return true; }
  bool observesRotors() const noexcept override { return true; }
  double rotorLead() const noexcept override { return rotor_lead_; }
  const Telemetry& telemetry() const noexcept override { return telemetry_; }
  std::vector<AdaptiveQuantity> adaptiveQuantities() const override;

 private:
  // Where the vehicle is now, as far as the law can tell.
  struct Motion {
    State state;
    Eigen::Matrix3d attitude;      // R
    Eigen::Vector3d acceleration;  // in W [m/s^2]
  };
  // Of the position's loop, for adapt().
  struct Outer {
    Eigen::Vector3d sliding = Eigen::Vector3d::Zero();  // s_b
    double size = 0.0;                                  // ||s||
    double xi = 0.0;                                    // ||xi||
    bool learns_sideways = false;
    bool learns_vertically = false;
    bool clamped = false;
  };
  // Of the attitude's loop.
  struct Inner {
    double size = 0.0;
    double xi = 0.0;
  };
  struct Pushed {
    Eigen::Vector3d force;  // F in W [N]
    Eigen::Vector3d jerk;   // in W [m/s^3]
  };

  void sense(const Sensed& sensed, double dt) noexcept;
  Motion predict(const Sensed& sensed) const noexcept;
  Pushed push(const Motion& now, const SetPoint& set_point) noexcept;
  Eigen::Vector3d moment(const Motion& now, const Pushed& pushed,
                         const SetPoint& set_point) noexcept;
  void learnBias(double dt) noexcept;
  void report() noexcept;

  // Gains.
  double rotor_lead_;  // kappa
  TiltLimits tilt_;
  Approach sideways_;  // its braking depends on the thrust that is left
  Approach vertical_;
  Eigen::Vector3d gain_;        // lambda [1/s]
  double boundary_layer_;       // varpi_p [m/s]
  Eigen::Vector3d bias_drive_;  // gamma [1/s^2]
  Eigen::Vector3d turn_slope_;  // Phi_q [1/s]
  Eigen::Vector3d turn_gain_;   // lambda_q [1/s]
  double turn_boundary_layer_;  // varpi_q [rad/s]
  double rotor_time_;           // tau_r [s]
  ThrustShare share_;
  // What is learned.
  MassEstimate mass_;
  MomentObserver moment_;
  InertiaEstimate inertia_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();  // d_s in W [m/s^2]
  std::array<AdaptiveGain, 2> gains_;               // K_p
  std::array<AdaptiveGain, 3> turn_gains_;          // K_q
  // What the rotors do, and what was sensed last.
  AppliedWrench applied_;
  Ages ages_;
  Meanwhile given_;
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();         // as it was sensed
  Eigen::Vector3d mean_moment_ = Eigen::Vector3d::Zero();  // since the rate before
  double rate_elapsed_ = 0.0;                              // since then [s]
  bool followed_ = false;                                  // the last command was learned from
  bool follows_ = false;                                   // so that the present one may compare
  Outer outer_;
  Inner inner_;
  Telemetry telemetry_;
};

}  // namespace aqc

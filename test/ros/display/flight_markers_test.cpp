#include "ros/display/flight_markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ros/display/flight_paths.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

using visualization_msgs::Marker;

msgs::ControllerState hovering(double share) {
  msgs::ControllerState state;
  state.flying = true;
  state.controller = "asmc";
  state.mass_estimate = std::numeric_limits<double>::quiet_NaN();
  state.rotor_speeds.assign(4, share * test::pelican().max_rotor_speed);
  return state;
}

TEST(FlightMarkers, ErrorsGoFromGreenToRed) {
  EXPECT_GT(errorColour(0.0).g, errorColour(0.0).r);
  EXPECT_GT(errorColour(kWorstShownError).r, errorColour(kWorstShownError).g);
  EXPECT_EQ(errorColour(-0.1).r, errorColour(0.1).r);
  EXPECT_EQ(errorColour(1e9).g, errorColour(kWorstShownError).g);
  EXPECT_EQ(errorColour(std::nan("")).g, errorColour(kWorstShownError).g);
}

TEST(FlightMarkers, RotorsAtALimitAreRed) {
  for (const double share : {0.5, 1.0}) {
    const Markers arrows = thrustMarkers(hovering(share), test::pelican());
    ASSERT_EQ(arrows.size(), 4u);
    for (const Marker& arrow : arrows) {
      EXPECT_EQ(arrow.color.g < 0.2F, share == 1.0);
      EXPECT_EQ(arrow.header.frame_id, "base_link");
    }
  }
  EXPECT_TRUE(thrustMarkers(msgs::ControllerState(), test::pelican()).empty());
}

TEST(FlightMarkers, PayloadHangsAndCargoLies) {
  msgs::PlantStatus status;
  EXPECT_TRUE(payloadMarkers(status).empty());
  status.payload_mass = 0.4;
  status.payload_offset.z = -0.25;
  status.payload_size.x = 0.1;
  status.cargo_names = {"second"};
  status.cargo_positions.resize(1);
  status.cargo_sizes.resize(1);
  const Markers markers = payloadMarkers(status);
  ASSERT_EQ(markers.size(), 4u) << "rod, box, cargo, its name";
  EXPECT_EQ(markers[1].pose.position.z, -0.25);
  EXPECT_EQ(markers[3].text, "second");
}

TEST(FlightMarkers, WhatIsGoneIsDeleted) {
  const Markers shown = setPointMarkers(hovering(0.5));
  const visualization_msgs::MarkerArray message = withDeletions(shown, {});
  ASSERT_EQ(message.markers.size(), shown.size());
  for (const Marker& marker : message.markers) EXPECT_EQ(marker.action, Marker::DELETE);
  EXPECT_EQ(withDeletions(shown, shown).markers.size(), shown.size());
}

TEST(FlightMarkers, TheTextNamesTheMode) {
  msgs::ControllerState state = hovering(0.5);
  EXPECT_EQ(flightMode(state, nullptr), "flying");
  state.saturated = true;
  EXPECT_EQ(flightMode(state, nullptr), "saturated");
  state.mode = "holding";
  state.mode_reason = "operator";
  EXPECT_EQ(flightMode(state, nullptr), "holding (operator)");
  msgs::PlantStatus status;
  status.crashed = true;
  status.crash_reason = "rotor strike";
  EXPECT_EQ(flightMode(state, &status), "crashed: rotor strike");
  EXPECT_NE(textMarkers(state, &status, test::pelican())[0].text.find("mass 2.00 kg"),
            std::string::npos);
}

TEST(FlightPaths, ThinsOutAndBreaksAtJumps) {
  FlightTrail trail;
  for (int i = 0; i < 100; ++i) trail.add({0.01 * i, 0.0, 1.0}, 0.0);
  EXPECT_NEAR(static_cast<double>(trail.size()), 1.0 / FlightTrail::kSpacing, 2.0);
  const std::size_t lines = trail.marker().points.size();
  trail.add({50.0, 0.0, 1.0}, 0.0);
  trail.add({std::nan(""), 0.0, 1.0}, 0.0);
  EXPECT_EQ(trail.marker().points.size(), lines);
  EXPECT_EQ(trail.marker().colors.size(), lines);
}

}  // namespace
}  // namespace aqc

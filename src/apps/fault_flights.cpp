// Flies a guarded law through random faults, each flight from its seed: a table on the terminal, a
// CSV file.

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "campaign/campaign.h"
#include "campaign/margins.h"
#include "report/progress_bar.h"
#include "report/resources.h"
#include "report/run_program.h"

namespace aqc {
namespace {

struct Options {
  Campaign campaign;
  std::string law = "asmc";
  std::string vehicle = "pelican_thesis";
  std::string csv;
  std::uint64_t only = 0;
  bool margins = false;
};

PilotLimits guarded() {
  PilotLimits limits;
  limits.guard = GuardLimits();
  return limits;
}

std::string text(const Eigen::Vector3d& vector) {
  return formatted("(%6.2f, %6.2f, %6.2f)", vector.x(), vector.y(), vector.z());
}

// One flight, with what the guard does.
void flyOnly(std::uint64_t seed, const Vehicle& vehicle, const ControlLaw& law) {
  const FaultFlight flight = drawFaultFlight(seed, vehicle);
  std::cout << flightText(flight);
  std::string last;
  Nanoseconds told = 0;
  const FaultResult result =
      flyFaults(flight, vehicle, law.clone(), guarded(), [&](const ClosedLoop& loop) {
        const Guard& guard = *loop.pilot().guard();
        const std::string is =
            std::string(toString(guard.mode())) + ": " + textOf(guard.rule()).name;
        const Nanoseconds now = loop.plant().now();
        if (is == last && now - told < fromSeconds(1.0)) return;
        last = is;
        told = now;
        const State state = loop.plant().plant().state();
        const Eigen::Vector3d to = loop.pilot().sample().set_point.position;
        const double up = (state.attitude * Eigen::Vector3d::UnitZ()).z();
        std::cout << formatted("%8.3f s  %-34s", toSeconds(now), is.c_str()) << text(state.position)
                  << " m, " << text(state.velocity) << formatted(" m/s, up %.2f, to ", up)
                  << text(to) << " m\n";
      });
  std::cout << campaignCsv({result}) << std::flush;
}

// How much of each fault each law bears by itself.
void printMargins(const std::string& config, const Vehicle& vehicle) {
  ProgressBar progress("measuring margins");
  std::string table = marginsHeading();
  const std::string laws[] = {"asmc", "smc", "geometric"};
  for (const std::string& name : laws) {
    const auto law = loadLaw(findResource(config, "controller", name), vehicle);
    table += marginsRow(name, measureMargins(vehicle, *law, guarded()));
  }
  progress.finish();
  std::cout << table << std::flush;
}

void run(const Options& options) {
  const std::string config = configFolder();
  const Vehicle vehicle = loadVehicle(findResource(config, "vehicle", options.vehicle));
  if (options.margins) return printMargins(config, vehicle);
  const auto law = loadLaw(findResource(config, "controller", options.law), vehicle);
  if (options.only > 0) return flyOnly(options.only, vehicle, *law);
  ProgressBar progress("flying faults with " + options.law);
  const auto results = flyCampaign(options.campaign, vehicle, *law, guarded(),
                                   [&](double share) { progress.update(share); });
  progress.finish();
  std::cout << campaignTable(results) << std::flush;
  if (options.csv.empty()) return;
  std::ofstream file(options.csv, std::ios::binary);
  file << campaignCsv(results);
  if (!file.flush()) throw std::runtime_error("cannot write '" + options.csv + "'");
}

void addOptions(CLI::App& app, Options& options) {
  app.add_option("-n,--flights", options.campaign.flights, "how many")
      ->check(CLI::Range(1, 10'000'000))
      ->default_val(200);
  app.add_option("-s,--seed", options.campaign.seed, "of the first; the others follow")
      ->default_val(1);
  app.add_option("-c,--law,--controller", options.law, "file, or name of one in config/controller")
      ->default_str("asmc");
  app.add_option("-v,--vehicle", options.vehicle, "file, or name of one in config/vehicle")
      ->default_str("pelican_thesis");
  app.add_option("-t,--threads", options.campaign.threads,
                 "the results are the same for any number")
      ->check(CLI::Range(1, 1024))
      ->default_val(std::max(1u, std::thread::hardware_concurrency()));
  app.add_option("--csv", options.csv, "write a line a flight to this file")->type_name("FILE");
  app.add_option("--only", options.only, "fly this seed alone and tell what happens")
      ->type_name("SEED");
  app.add_flag("--margins", options.margins, "how much of each fault asmc, smc and geometric bear");
}

}  // namespace
}  // namespace aqc

int main(int argc, char** argv) {
  CLI::App app("Flies a guarded law through random faults.", "fault_flights");
  aqc::Options options;
  aqc::addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  return aqc::runProgram("fault_flights", [&] { aqc::run(options); });
}

// Flies laws through random flights with payloads, wind, noise and delay, the same ones for each: a
// table on the terminal, a line a flight in a CSV file.

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "campaign/payload_campaign.h"
#include "report/progress_bar.h"
#include "report/resources.h"
#include "report/run_program.h"

namespace aqc {
namespace {

struct Options {
  PayloadCampaign campaign;
  std::string flights = "1..200";
  std::vector<std::string> laws = {"composite"};
  std::string vehicle = "pelican";
  std::string csv;
  bool no_imu = false;
};

// A whole number >= 0, else -1.
int numberOf(const std::string& text) {
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  return digits && !text.empty() && text.size() < 10 ? std::stoi(text) : -1;
}

// "A..B", or "A" alone.
void readFlights(const std::string& text, PayloadCampaign& campaign) {
  const std::size_t dots = text.find("..");
  campaign.first = numberOf(text.substr(0, dots));
  campaign.last = dots == std::string::npos ? campaign.first : numberOf(text.substr(dots + 2));
  if (campaign.first < 0 || campaign.last < campaign.first) {
    throw std::runtime_error("flights are '" + text + "'; they must be like 1..200 or 17");
  }
}

void run(const Options& options) {
  PayloadCampaign campaign = options.campaign;
  campaign.conditions.imu = !options.no_imu;
  readFlights(options.flights, campaign);
  const std::string config = configFolder();
  const Vehicle vehicle = loadVehicle(findResource(config, "vehicle", options.vehicle));
  std::string table = summaryHeading();
  std::string lines = payloadCsvHeading();
  for (const std::string& wanted : options.laws) {
    const std::string path = findResource(config, "controller", wanted);
    const std::string name = resourceName(path);
    const auto law = loadLaw(path, vehicle);
    ProgressBar progress("flying payloads with " + name);
    const auto results =
        flyCampaign(campaign, vehicle, *law, [&](double share) { progress.update(share); });
    progress.finish();
    table += summaryRow(name, summary(results));
    lines += payloadCsv(name, results);
  }
  std::cout << table << std::flush;
  if (options.csv.empty()) return;
  std::ofstream file(options.csv, std::ios::binary);
  file << lines;
  if (!file.flush()) throw std::runtime_error("cannot write '" + options.csv + "'");
}

void addOptions(CLI::App& app, Options& options) {
  app.add_option("-n,--flights", options.flights, "numbers of the first and of the last one")
      ->default_str("1..200")
      ->type_name("A..B");
  app.add_option("--campaign", options.campaign.campaign, "another number: other flights")
      ->default_val(1);
  app.add_option("-c,--controller", options.laws,
                 "files, or names of some in config/controller, separated by commas")
      ->delimiter(',')
      ->default_str("composite")
      ->type_name("NAME,...");
  app.add_option("-v,--vehicle", options.vehicle, "file, or name of one in config/vehicle")
      ->default_str("pelican");
  app.add_flag("--no-imu", options.no_imu, "there is no accelerometer");
  app.add_flag("--wrong", options.campaign.conditions.wrong,
               "vehicle file and sensors are wrong in everything");
  app.add_option("-t,--threads", options.campaign.threads,
                 "the results are the same for any number")
      ->check(CLI::Range(1, 1024))
      ->default_val(std::max(1u, std::thread::hardware_concurrency()));
  app.add_option("--csv", options.csv, "write a line a flight to this file")->type_name("FILE");
}

}  // namespace
}  // namespace aqc

int main(int argc, char** argv) {
  CLI::App app("Flies laws through random flights with payloads.", "payload_flights");
  aqc::Options options;
  aqc::addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  return aqc::runProgram("payload_flights", [&] { aqc::run(options); });
}

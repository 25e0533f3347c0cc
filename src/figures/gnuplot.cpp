#include "figures/gnuplot.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "report/flight_files.h"

namespace aqc {
namespace {

constexpr int kMissing = 127;  // what a shell returns for a program it does not find
constexpr int kNoFolder = 126;
constexpr int kPatience = 100;  // between two signs of life [ms]

// In the child process, where only calls that are safe after fork() are allowed.
[[noreturn]] void becomeGnuplot(const char* folder, const char* script, int errors) {
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (chdir(folder) != 0 || nothing < 0) _exit(kNoFolder);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  execlp("gnuplot", "gnuplot", script, static_cast<char*>(nullptr));
  _exit(kMissing);
}

std::string readAll(int file) {
  std::string text;
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

// gnuplot repeats the command and points at the mistake before it says what is wrong.
std::string lastLine(const std::string& text) {
  std::istringstream lines(text);
  std::string last = "no message";
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string::npos) last = line.substr(begin);
  }
  return last;
}

// gnuplot does not always notice a full disk; a whole PNG ends with the chunk IEND.
void checkPng(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  constexpr std::size_t kTail = 8;  // "IEND" and its checksum
  if (bytes.size() < kTail || bytes.compare(bytes.size() - kTail, 4, "IEND") != 0) {
    throw std::runtime_error("gnuplot could not write all of '" + path + "'");
  }
}

}  // namespace

Gnuplot::Gnuplot(std::string folder, std::string script)
    : folder_(std::move(folder)), script_(std::move(script)) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("cannot run gnuplot: ") + std::strerror(errno));
  }
  errors_ = ends[0];
  child_ = fork();
  if (child_ == 0) becomeGnuplot(folder_.c_str(), script_.c_str(), ends[1]);
  const int failure = errno;
  close(ends[1]);
  if (child_ < 0) {
    close(errors_);
    throw std::runtime_error(std::string("cannot run gnuplot: ") + std::strerror(failure));
  }
}

bool Gnuplot::settled(int milliseconds) const noexcept {
  pollfd end{errors_, POLLIN, 0};
  return child_ < 0 || poll(&end, 1, milliseconds) > 0;
}

void Gnuplot::collect() noexcept {
  if (child_ < 0) return;
  messages_ = readAll(errors_);
  close(errors_);
  while (waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
}

void Gnuplot::wait() {
  collect();
  if (WIFEXITED(status_) && WEXITSTATUS(status_) == 0) return;
  if (WIFEXITED(status_) && WEXITSTATUS(status_) == kMissing) {
    throw std::runtime_error(
        "gnuplot is not installed, so there are no figures; their scripts, "
        "*.gnuplot, are in '" +
        folder_ + "'");
  }
  throw std::runtime_error("gnuplot failed at '" + folder_ + "/" + script_ +
                           "': " + lastLine(messages_));
}

std::vector<std::string> runGnuplot(const std::string& folder,
                                    const std::vector<GnuplotScript>& scripts,
                                    const std::function<void(double)>& progress) {
  const auto path = [&](const std::string& file) {
    return (std::filesystem::path(folder) / file).string();
  };
  for (const GnuplotScript& script : scripts)
    writeFile(path(script.name + ".gnuplot"), script.text);
  std::vector<std::unique_ptr<Gnuplot>> runs;
  for (const GnuplotScript& script : scripts) {
    runs.push_back(std::make_unique<Gnuplot>(folder, script.name + ".gnuplot"));
  }
  const auto report = [&](std::size_t done) {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(runs.size()));
  };
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    while (!runs[i]->settled(kPatience)) report(i);
    runs[i]->wait();
    paths.push_back(path(scripts[i].name + ".png"));
    checkPng(paths.back());
    report(i + 1);
  }
  return paths;
}

}  // namespace aqc

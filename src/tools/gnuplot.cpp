#include "gnuplot.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace aqc {
namespace {

constexpr int kMissing = 127;  // what a shell returns for a program it does not find
constexpr int kNoFolder = 126;

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

}  // namespace aqc

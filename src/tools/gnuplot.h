#pragma once

#include <sys/types.h>

#include <string>

namespace aqc {

/// `gnuplot SCRIPT` in `folder`, without a shell; several may run side by side.
class Gnuplot {
 public:
  /// Starts it. Throws std::runtime_error when the system refuses.
  Gnuplot(std::string folder, std::string script);
  ~Gnuplot() { collect(); }
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  /// Whether it ends, or has something to say, within so many milliseconds.
  bool settled(int milliseconds) const noexcept;

  /// Waits for its end. Throws std::runtime_error, with a message of one line, when gnuplot is
  /// missing or failed.
  void wait();

 private:
  void collect() noexcept;

  std::string folder_;
  std::string script_;
  pid_t child_ = -1;
  int errors_ = -1;  // what it writes to stderr
  int status_ = 0;
  std::string messages_;
};

}  // namespace aqc

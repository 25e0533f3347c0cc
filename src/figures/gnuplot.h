#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

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

/// What draws the picture `name`.png.
struct GnuplotScript {
  std::string name;
  std::string text;
};

/// Writes the scripts into `folder` and runs them side by side. Returns the paths of the pictures;
/// `progress` (may be empty) is told the share done. Throws std::runtime_error when a script cannot
/// be written or gnuplot is missing, fails or leaves half a picture.
std::vector<std::string> runGnuplot(const std::string& folder,
                                    const std::vector<GnuplotScript>& scripts,
                                    const std::function<void(double)>& progress);

}  // namespace aqc

#include "campaign/in_parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace aqc {

void inParallel(int count, int threads, const std::function<void(int)>& work,
                const std::function<void(double)>& progress) {
  std::atomic<int> next{0};
  std::mutex counting;
  int done = 0;
  std::exception_ptr failure;
  const auto attempt = [&](int i) noexcept {
    try {
      work(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(counting);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  const auto take = [&] {
    for (int i = next++; i < count; i = next++) {
      attempt(i);
      const std::lock_guard<std::mutex> lock(counting);
      ++done;
      if (progress) progress(static_cast<double>(done) / count);
    }
  };
  std::vector<std::thread> team;
  for (int i = 0; i < threads; ++i) team.emplace_back(take);
  for (std::thread& thread : team) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace aqc

#include "campaign/in_parallel.h"

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

namespace aqc {

void inParallel(int count, int threads, const std::function<void(int)>& work,
                const std::function<void(double)>& progress) {
  std::atomic<int> next{0};
  std::mutex counting;
  int done = 0;
  const auto take = [&] {
    for (int i = next++; i < count; i = next++) {
      work(i);
      const std::lock_guard<std::mutex> lock(counting);
      ++done;
      if (progress) progress(static_cast<double>(done) / count);
    }
  };
  std::vector<std::thread> team;
  for (int i = 0; i < threads; ++i) team.emplace_back(take);
  for (std::thread& thread : team) thread.join();
}

}  // namespace aqc

#pragma once

#include <functional>

namespace aqc {

/// Calls `work(i)` once for every i from 0 to `count` - 1, from `threads` (>= 1) threads at a time
/// and in no order. What one of them throws ends the others after the call they are in, and is
/// thrown again. `progress` (may be empty) is told the share that is done, 0
/// to 1, by one thread at a time.
void inParallel(int count, int threads, const std::function<void(int)>& work,
                const std::function<void(double)>& progress);

}  // namespace aqc

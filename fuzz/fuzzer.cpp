// One target of fuzz/targets.h as a program of libFuzzer; AQC_FUZZ_TARGET is its place there.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fuzz/mutation.h"
#include "fuzz/targets.h"

namespace {

constexpr const aqc::fuzz::Target& kTarget = aqc::fuzz::kTargets[AQC_FUZZ_TARGET];

std::string text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string finding = kTarget.check(text(data, size));
  if (finding.empty()) return 0;
  std::fprintf(stderr, "FINDING: %s: %s\n", kTarget.name, finding.c_str());
  std::abort();
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (kTarget.config != nullptr && seed % 8 != 0) {
    const std::string mutated = aqc::fuzz::mutatedYaml(text(data, size), seed);
    if (!mutated.empty() && mutated.size() <= most) {
      std::copy(mutated.begin(), mutated.end(), data);
      return mutated.size();
    }
  }
  return LLVMFuzzerMutate(data, size, most);
}

// A target of fuzz/targets.h as a program of libFuzzer: AQC_FUZZ_CHECK is its function, and
// AQC_FUZZ_YAML whether it reads YAML.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fuzz/mutation.h"
#include "fuzz/targets.h"

namespace {

std::string text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string finding = aqc::fuzz::AQC_FUZZ_CHECK(text(data, size));
  if (finding.empty()) return 0;
  std::fprintf(stderr, "FINDING: %s\n", finding.c_str());
  std::abort();
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (AQC_FUZZ_YAML != 0 && seed % 8 != 0) {
    const std::string mutated = aqc::fuzz::mutatedYaml(text(data, size), seed);
    if (!mutated.empty() && mutated.size() <= most) {
      std::copy(mutated.begin(), mutated.end(), data);
      return mutated.size();
    }
  }
  return LLVMFuzzerMutate(data, size, most);
}

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace aqc::fuzz {

/// Numbers that a conversion, a square or a comparison may not have been thought through for.
constexpr std::array<double, 14> kExtremes = {0.0,
                                              -0.0,
                                              1.0,
                                              -1.0,
                                              std::numeric_limits<double>::quiet_NaN(),
                                              std::numeric_limits<double>::infinity(),
                                              -std::numeric_limits<double>::infinity(),
                                              1e308,
                                              -1e308,
                                              1e160,
                                              1e30,
                                              -1e30,
                                              1e-308,
                                              5e-324};

/// What is said, made of bytes: every string of bytes says something, and a change of one byte
/// changes one thing. When none are left, all is zero. (clang's FuzzedDataProvider comes with clang
/// alone.)
class Bytes {
 public:
  Bytes(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), left_(size) {}

  bool empty() const { return left_ == 0; }
  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *bytes_++;
  }
  /// 0 to `count` - 1.
  std::size_t choice(std::size_t count) { return byte() % count; }
  std::uint64_t word(int size) {
    std::uint64_t word = 0;
    for (int i = 0; i < size; ++i) word = (word << 8u) | byte();
    return word;
  }
  /// Mostly one within +-`usual`, in 65536 steps; sometimes an extreme, and sometimes any.
  double number(double usual) {
    const std::uint8_t kind = byte();
    if (kind == 255) {
      const std::uint64_t bits = word(8);
      double any = 0.0;
      std::memcpy(&any, &bits, sizeof any);
      return any;
    }
    if (kind >= 240) return kExtremes.at(static_cast<std::size_t>(kind - 240) % kExtremes.size());
    return usual * static_cast<double>(static_cast<std::int16_t>(word(2))) / 32768.0;
  }

 private:
  const std::uint8_t* bytes_;
  std::size_t left_;
};

}  // namespace aqc::fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.hpp"

#include <algorithm>

namespace lego_loam_sc {

// A control byte c below 32 is followed by c + 1 bytes to copy. Any other is a reference back into
// the output: its upper three bits are the length less 2 (7: one more byte adds to it), its lower
// five and one more byte the distance less 1.
std::optional<std::string> decompress_lzf(std::string_view data, std::size_t size) {
  constexpr std::size_t kLongestRun = 7 + 255 + 2;
  constexpr std::size_t kBytesPerRun = 3;
  if (size > (data.size() / kBytesPerRun + 1) * kLongestRun) return std::nullopt;

  std::string out(size, '\0');
  std::size_t made = 0;
  std::size_t at = 0;
  const auto next = [&] {
    return static_cast<std::size_t>(static_cast<unsigned char>(data[at++]));
  };
  while (at < data.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > data.size() - at || length > size - made) return std::nullopt;
      std::copy_n(data.data() + at, length, out.data() + made);
      at += length;
      made += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at == data.size()) return std::nullopt;
      length += next();
    }
    length += 2;
    if (at == data.size()) return std::nullopt;
    const std::size_t distance = ((control & 31) << 8) + next() + 1;
    if (distance > made || length > size - made) return std::nullopt;
    // Byte by byte: a reference may overlap its own output, which repeats a pattern.
    for (std::size_t i = 0; i < length; ++i, ++made) out[made] = out[made - distance];
  }
  if (made != size) return std::nullopt;
  return out;
}

}  // namespace lego_loam_sc

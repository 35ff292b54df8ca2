// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply.hpp"

#include "point_file.hpp"

using namespace lego_loam_sc;

int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string bytes = text_of(data, size);
  read_or_refuse([&] { follow(parse_ply(bytes, "file")); });
  return 0;
}

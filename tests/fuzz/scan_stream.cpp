// SPDX-License-Identifier: BSD-3-Clause
#include "io/scan_stream.hpp"

#include <sstream>
#include <vector>

#include "fuzz.hpp"

using namespace lego_loam_sc;

namespace {

std::vector<Scan> read_all(ScanStreamReader& reader) {
  std::vector<Scan> scans;
  read_or_refuse([&] {
    while (std::optional<Scan> scan = reader.next()) scans.push_back(std::move(*scan));
  });
  return scans;
}

}  // namespace

// What was read is written and read again.
int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  std::istringstream in(text_of(data, size));
  read_or_refuse([&] {
    ScanStreamReader reader(in, "stream");
    const std::vector<Scan> scans = read_all(reader);
    std::stringstream copy;
    ScanStreamWriter writer(copy, reader.facts());
    for (const Scan& scan : scans) {
      require_whole(scan);
      writer.write(scan);
    }
    ScanStreamReader second(copy, "copy");
    const std::vector<Scan> again = read_all(second);
    require(again.size() == scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i)
      require(again[i].stamp_ns == scans[i].stamp_ns && again[i].size() == scans[i].size());
  });
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/scan.hpp"
#include "io/dataset_facts.hpp"

namespace lego_loam_sc {

// The format is described in docs/scan-stream.md.

constexpr std::string_view kScanStreamMagic = "LLSCSCAN";

/// Writes scans to a binary stream, the header on construction. Throws InputError when the stream
/// does not take them or the scan's arrays differ in length.
class ScanStreamWriter {
 public:
  explicit ScanStreamWriter(std::ostream& out, const DatasetFacts& facts = {});
  void write(const Scan& scan);

 private:
  std::ostream& out_;
};

/// Reads scans from a binary stream. Throws InputError that names `name`, the number of whole scans
/// and the byte when the stream is cut off or damaged; after that `next` returns nothing. Memory
/// grows with what arrives, not with what a header promises.
class ScanStreamReader {
 public:
  ScanStreamReader(std::istream& in, std::string name);
  const DatasetFacts& facts() const { return facts_; }
  std::optional<Scan> next();

 private:
  void read(char* bytes, std::size_t size);
  template <class T>
  T read_number();
  template <class T>
  std::vector<T> read_array(std::size_t count);
  [[noreturn]] void fail(const std::string& what);

  std::istream& in_;
  std::string name_;
  DatasetFacts facts_;
  std::size_t byte_ = 0;
  std::size_t scans_ = 0;
  bool ended_ = false;
};

}  // namespace lego_loam_sc

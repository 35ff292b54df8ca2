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

/// Writes scans to a binary stream; the constructor writes the header. Throws InputError when
/// writing fails or the arrays of a scan differ in length.
class ScanStreamWriter {
 public:
  explicit ScanStreamWriter(std::ostream& out, const DatasetFacts& facts = {});
  void write(const Scan& scan);

 private:
  std::ostream& out_;
};

/// Reads scans from a binary stream. When the stream is truncated or corrupt, throws InputError
/// with `name`, the number of complete scans and the byte; after that `next` returns nothing.
/// Memory grows with the data received, not with the size that a header declares.
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

// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/bytes.hpp"
#include "io/file.hpp"
#include "io/lzf.hpp"

namespace lego_loam_sc {
namespace {

struct Field {
  std::string name;
  NumberType type;
  std::size_t count;  // numbers per point; more than one in padding and descriptors

  std::size_t bytes() const { return size_of(type) * count; }
};

struct Header {
  std::vector<Field> fields;
  std::size_t points = 0;
  std::string encoding;

  std::size_t point_bytes() const {
    std::size_t sum = 0;
    for (const Field& field : fields) sum += field.bytes();
    return sum;
  }
};

using Lines = std::map<std::string, std::vector<std::string>, std::less<>>;

// Removes the header from the front of `rest`: the words of each line by its keyword.
Lines take_header_lines(std::string_view& rest, const std::string& file) {
  Lines lines;
  while (!rest.empty()) {
    std::string_view line = take_line(rest);
    const std::string keyword(take_word(line));
    if (keyword.empty() || keyword.starts_with('#')) continue;
    std::vector<std::string>& words = lines[keyword];
    words.clear();
    for (auto word = take_word(line); !word.empty(); word = take_word(line))
      words.emplace_back(word);
    if (keyword == "DATA") return lines;
  }
  throw InputError(file + " has no line DATA; it is truncated or not a PCD file");
}

std::optional<NumberType> number_type(std::string_view type, std::string_view size) {
  static constexpr struct {
    std::string_view type, size;
    NumberType number;
  } kTypes[] = {{"I", "1", NumberType::int8},    {"U", "1", NumberType::uint8},
                {"I", "2", NumberType::int16},   {"U", "2", NumberType::uint16},
                {"I", "4", NumberType::int32},   {"U", "4", NumberType::uint32},
                {"I", "8", NumberType::int64},   {"U", "8", NumberType::uint64},
                {"F", "4", NumberType::float32}, {"F", "8", NumberType::float64}};
  for (const auto& known : kTypes)
    if (known.type == type && known.size == size) return known.number;
  return std::nullopt;
}

std::vector<Field> parse_fields(const Lines& lines, const std::string& file) {
  constexpr std::size_t kMaxCount = 1'000'000;  // keeps every sum of sizes far from overflow
  const auto names = lines.find("FIELDS"), sizes = lines.find("SIZE"), types = lines.find("TYPE"),
             counts = lines.find("COUNT");
  if (names == lines.end() || names->second.empty() || sizes == lines.end() || types == lines.end())
    throw InputError(file + ": the header must have the lines FIELDS, SIZE and TYPE");
  const std::size_t n = names->second.size();
  if (sizes->second.size() != n || types->second.size() != n ||
      (counts != lines.end() && counts->second.size() != n))
    throw InputError(file + ": FIELDS, SIZE, TYPE and COUNT must have one entry for each field");
  std::vector<Field> fields;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string& name = names->second[i];
    const auto type = number_type(types->second[i], sizes->second[i]);
    if (!type)
      throw InputError(file + ": field " + name + " has TYPE " + types->second[i] + " and SIZE " +
                       sizes->second[i] + "; I and U come in 1, 2, 4, 8 bytes, F in 4 and 8");
    std::optional<std::size_t> count = 1;
    if (counts != lines.end()) count = parse_integer<std::size_t>(counts->second[i]);
    if (!count || *count == 0 || *count > kMaxCount)
      throw InputError(file + ": field " + name + " has COUNT " + counts->second[i] +
                       ", it must be between 1 and 1000000");
    fields.push_back({name, *type, *count});
  }
  return fields;
}

std::optional<std::size_t> parse_count(const Lines& lines, std::string_view keyword,
                                       const std::string& file) {
  const auto line = lines.find(keyword);
  if (line == lines.end()) return std::nullopt;
  const auto value =
      line->second.size() == 1 ? parse_integer<std::size_t>(line->second.front()) : std::nullopt;
  if (!value) throw InputError(file + ": " + std::string(keyword) + " must be an integer");
  return value;
}

std::size_t parse_points(const Lines& lines, const std::string& file) {
  const auto points = parse_count(lines, "POINTS", file);
  const auto width = parse_count(lines, "WIDTH", file);
  const std::size_t height = parse_count(lines, "HEIGHT", file).value_or(1);
  if (!width) {
    if (!points) throw InputError(file + ": the header has neither POINTS nor WIDTH");
    return *points;
  }
  if (height != 0 && *width > std::numeric_limits<std::size_t>::max() / height)
    throw InputError(file + ": WIDTH times HEIGHT is too large");
  if (points && *points != *width * height)
    throw InputError(file + ": POINTS is " + std::to_string(*points) + ", WIDTH times HEIGHT is " +
                     std::to_string(*width * height) + "; they must be equal");
  return *width * height;
}

Header take_header(std::string_view& rest, const std::string& file) {
  const Lines lines = take_header_lines(rest, file);
  Header header{parse_fields(lines, file), parse_points(lines, file), {}};
  const auto& data = lines.find("DATA")->second;
  if (data.size() == 1) header.encoding = data.front();
  return header;
}

[[noreturn]] void fail_size(const Header& header, std::size_t bytes, const std::string& file) {
  throw InputError(file + ": the header declares " + std::to_string(header.points) + " points of " +
                   std::to_string(header.point_bytes()) + " bytes, the data has " +
                   std::to_string(bytes) + " bytes; the file is truncated or its header invalid");
}

RawScan parse_binary(const Header& header, std::string_view data, const std::string& file) {
  // There may be more bytes: PCL pads files to whole memory pages.
  if (header.points > data.size() / header.point_bytes()) fail_size(header, data.size(), file);
  std::vector<Column> columns;
  const char* at = data.data();
  for (const Field& field : header.fields) {
    columns.push_back({field.name, field.type, field.type, at, header.point_bytes()});
    at += field.bytes();
  }
  return assemble(columns, header.points, file);
}

// Compressed data is stored field by field.
RawScan parse_compressed(const Header& header, std::string_view data, const std::string& file) {
  constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
  if (data.size() < kSizes) throw InputError(file + " is truncated after its header");
  const auto packed = load<std::uint32_t>(data.data());
  const auto unpacked = load<std::uint32_t>(data.data() + sizeof(std::uint32_t));
  data.remove_prefix(kSizes);
  if (packed > data.size())
    throw InputError(file + " declares " + std::to_string(packed) + " compressed bytes and has " +
                     std::to_string(data.size()) + "; it is truncated");
  if (header.points > unpacked / header.point_bytes() ||
      header.points * header.point_bytes() != unpacked)
    fail_size(header, unpacked, file);
  const auto bytes = decompress_lzf(data.substr(0, packed), unpacked);
  if (!bytes) throw InputError(file + ": the compressed data is corrupt");
  std::vector<Column> columns;
  const char* at = bytes->data();
  for (const Field& field : header.fields) {
    columns.push_back({field.name, field.type, field.type, at, field.bytes()});
    at += field.bytes() * header.points;
  }
  return assemble(columns, header.points, file);
}

RawScan parse_ascii(const Header& header, std::string_view data, const std::string& file) {
  std::size_t words = 0;
  for (const Field& field : header.fields) words += field.count;
  const std::vector<double> table = take_numbers(data, header.points, words, file);
  if (!take_word(data).empty())
    throw InputError(file + " has more numbers than its " + std::to_string(header.points) +
                     " points need; the header is invalid");
  std::vector<Column> columns;
  const double* at = table.data();
  for (const Field& field : header.fields) {
    columns.push_back({field.name, field.type, NumberType::float64,
                       reinterpret_cast<const char*>(at), words * sizeof(double)});
    at += field.count;
  }
  return assemble(columns, header.points, file);
}

}  // namespace

RawScan read_pcd(const std::filesystem::path& path) {
  return parse_pcd(read_file(path), path.string());
}

RawScan parse_pcd(std::string_view bytes, const std::string& file) {
  const Header header = take_header(bytes, file);
  if (header.encoding == "binary") return parse_binary(header, bytes, file);
  if (header.encoding == "binary_compressed") return parse_compressed(header, bytes, file);
  if (header.encoding == "ascii") return parse_ascii(header, bytes, file);
  throw InputError(file + ": DATA must be ascii, binary or binary_compressed");
}

}  // namespace lego_loam_sc

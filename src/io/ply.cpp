// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/bytes.hpp"
#include "io/file.hpp"

namespace lego_loam_sc {
namespace {

struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> list_count;  // type of the number of entries, for lists
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;

  bool has_list() const {
    return std::ranges::any_of(properties,
                               [](const Property& p) { return p.list_count.has_value(); });
  }
  std::size_t bytes() const {  // of one record, without lists
    std::size_t sum = 0;
    for (const Property& property : properties) sum += size_of(property.type);
    return sum;
  }
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

NumberType number_type(std::string_view word, const std::string& file) {
  static constexpr struct {
    std::string_view old_name, name;
    NumberType type;
  } kTypes[] = {
      {"char", "int8", NumberType::int8},        {"uchar", "uint8", NumberType::uint8},
      {"short", "int16", NumberType::int16},     {"ushort", "uint16", NumberType::uint16},
      {"int", "int32", NumberType::int32},       {"uint", "uint32", NumberType::uint32},
      {"float", "float32", NumberType::float32}, {"double", "float64", NumberType::float64}};
  for (const auto& known : kTypes)
    if (word == known.old_name || word == known.name) return known.type;
  throw InputError(file + ": \"" + std::string(word.substr(0, 40)) +
                   "\" is not a type of a PLY property");
}

Property parse_property(std::string_view line, const std::string& file) {
  std::string_view type = take_word(line);
  std::optional<NumberType> list_count;
  if (type == "list") {
    list_count = number_type(take_word(line), file);
    type = take_word(line);
  }
  const NumberType number = number_type(type, file);
  return {std::string(take_word(line)), number, list_count};
}

Header take_header(std::string_view& rest, const std::string& file) {
  if (take_line(rest) != "ply") throw InputError(file + " does not begin with the line \"ply\"");
  Header header;
  while (!rest.empty()) {
    std::string_view line = take_line(rest);
    const std::string_view keyword = take_word(line);
    if (keyword == "format") {
      header.format = take_word(line);
    } else if (keyword == "element") {
      const std::string name(take_word(line));
      const auto count = parse_integer<std::size_t>(take_word(line));
      if (!count) throw InputError(file + ": element " + name + " has no valid count");
      header.elements.push_back({name, *count, {}});
    } else if (keyword == "property") {
      if (header.elements.empty())
        throw InputError(file + ": a property precedes the first element");
      header.elements.back().properties.push_back(parse_property(line, file));
    } else if (keyword == "end_header") {
      return header;
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      throw InputError(file + ": \"" + std::string(keyword.substr(0, 40)) +
                       "\" is not a keyword of a PLY header");
    }
  }
  throw InputError(file + " has no line end_header; it is truncated");
}

[[noreturn]] void fail_short(const Element& element, const std::string& file) {
  throw InputError(file + ": the header declares " + std::to_string(element.count) +
                   " records of element " + element.name + ", the data ends before them");
}

std::size_t list_length(double value, const Element& element, const std::string& file) {
  if (!(value >= 0.0 && value <= 4294967295.0 && value == std::floor(value)))
    throw InputError(file + ": a list in element " + element.name + " has the length " +
                     to_text(value));
  return static_cast<std::size_t>(value);
}

double load_number(const char* at, NumberType type, bool big_endian) {
  const auto as = [&]<class T>(T) {
    return static_cast<double>(big_endian ? load_big_endian<T>(at) : load<T>(at));
  };
  switch (type) {
    case NumberType::int8: return as(std::int8_t{});
    case NumberType::uint8: return as(std::uint8_t{});
    case NumberType::int16: return as(std::int16_t{});
    case NumberType::uint16: return as(std::uint16_t{});
    case NumberType::int32: return as(std::int32_t{});
    case NumberType::uint32: return as(std::uint32_t{});
    case NumberType::float32: return as(float{});
    default: return as(double{});
  }
}

void skip_binary(std::string_view& rest, const Element& element, bool big_endian,
                 const std::string& file) {
  const auto skip = [&](std::size_t bytes) {
    if (bytes > rest.size()) fail_short(element, file);
    rest.remove_prefix(bytes);
  };
  if (element.properties.empty()) return;
  if (!element.has_list()) {
    if (element.count > rest.size() / element.bytes()) fail_short(element, file);
    skip(element.count * element.bytes());
    return;
  }
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      std::size_t entries = 1;
      if (property.list_count) {
        const char* at = rest.data();
        skip(size_of(*property.list_count));
        entries = list_length(load_number(at, *property.list_count, big_endian), element, file);
      }
      skip(entries * size_of(property.type));
    }
  }
}

void skip_ascii(std::string_view& rest, const Element& element, const std::string& file) {
  if (element.properties.empty()) return;
  const auto take = [&] {
    const std::string_view word = take_word(rest);
    if (word.empty()) fail_short(element, file);
    return word;
  };
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      std::size_t entries = 1;
      if (property.list_count)
        entries = list_length(parse_double(take()).value_or(-1.0), element, file);
      for (std::size_t k = 0; k < entries; ++k) take();
    }
  }
}

RawScan parse_binary(std::string_view data, const Element& vertex, bool big_endian,
                     const std::string& file) {
  const std::size_t stride = vertex.bytes();
  if (vertex.count > data.size() / stride) fail_short(vertex, file);
  std::vector<Column> columns;
  const char* at = data.data();
  for (const Property& property : vertex.properties) {
    columns.push_back({property.name, property.type, property.type, at, stride, big_endian});
    at += size_of(property.type);
  }
  return assemble(columns, vertex.count, file);
}

RawScan parse_ascii(std::string_view data, const Element& vertex, const std::string& file) {
  const std::size_t width = vertex.properties.size();
  const std::vector<double> table = take_numbers(data, vertex.count, width, file);
  std::vector<Column> columns;
  const double* at = table.data();
  for (const Property& property : vertex.properties)
    columns.push_back({property.name, property.type, NumberType::float64,
                       reinterpret_cast<const char*>(at++), width * sizeof(double)});
  return assemble(columns, vertex.count, file);
}

}  // namespace

RawScan read_ply(const std::filesystem::path& path) {
  return parse_ply(read_file(path), path.string());
}

RawScan parse_ply(std::string_view bytes, const std::string& file) {
  std::string_view rest = bytes;
  const Header header = take_header(rest, file);
  const bool ascii = header.format == "ascii";
  const bool big_endian = header.format == "binary_big_endian";
  if (!ascii && !big_endian && header.format != "binary_little_endian")
    throw InputError(file + ": format must be ascii, binary_little_endian or binary_big_endian");
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      if (element.properties.empty() || element.has_list())
        throw InputError(file + ": element vertex must have scalar properties and no lists");
      return ascii ? parse_ascii(rest, element, file)
                   : parse_binary(rest, element, big_endian, file);
    }
    if (ascii)
      skip_ascii(rest, element, file);
    else
      skip_binary(rest, element, big_endian, file);
  }
  throw InputError(file + " has no element vertex");
}

}  // namespace lego_loam_sc

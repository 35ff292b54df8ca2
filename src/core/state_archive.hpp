// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lego_loam_sc {

// The state of a run as bytes and back. A class lists its members once:
//
//   template <class Archive>
//   void state(Archive& archive) {
//     archive(a_, b_);
//   }
//
// and is written by a StateWriter and read by a StateReader. Members are numbers, enumerations,
// Eigen's matrices and poses, strings, the containers below and classes with such a list. The bytes
// are as memory has them and mean something to the program that wrote them only.
//
// What only ever grows, and soon is most of the state, is listed with `archive.grown(vector)`: each
// writer gives its new elements only, and the bytes of all writers together hold them all.

/// The bytes do not hold the state that is to be read.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace state {

template <class T>
concept Listed = requires(T& value, int& archive) { value.template state<int>(archive); };
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
concept Matrix = std::is_base_of_v<Eigen::PlainObjectBase<T>, T> && T::SizeAtCompileTime > 0;

/// Head of some new elements of one growing container.
struct Growth {
  std::uint64_t number;  // of the container
  std::uint64_t elements;
  std::uint64_t bytes;
};

}  // namespace state

/// Elements of each growing container, in the order in which they are listed.
using GrownCounts = std::vector<std::size_t>;

/// Writes the state of objects, member by member.
class StateWriter {
 public:
  static constexpr bool kReads = false;

  /// Takes what comes behind the growth of the writers before, some at a time.
  using GrowthSink = std::function<void(std::string_view)>;

  /// `written`: what the writers before have given of the growing containers.
  explicit StateWriter(GrownCounts written = {}, GrowthSink growth = {})
      : written_(std::move(written)), growth_(std::move(growth)) {}

  /// Writes these values.
  template <class... Values>
  void operator()(const Values&... values) {
    (write(values), ...);
  }

  /// Writes what has come to a container that only grows.
  template <class T>
  void grown(const std::vector<T>& values) {
    grown<T>(values.size(), [&](std::size_t i) -> const T& { return values[i]; }, [](T&&) {});
  }

  /// The same for any container: `get(i)` gives an element, `add(element)` is for the reader.
  template <class T, class Get, class Add>
  void grown(std::size_t size, Get&& get, Add&&) {
    if (counts_.size() == written_.size()) written_.push_back(0);
    std::string elements;
    std::swap(elements, bytes_);
    std::size_t given = written_[counts_.size()];
    for (std::size_t i = given; i < size; ++i) {
      write(get(i));
      if (bytes_.size() < kGrowthAtOnce && i + 1 < size) continue;
      const state::Growth head{counts_.size(), i + 1 - given, bytes_.size()};
      growth_({reinterpret_cast<const char*>(&head), sizeof head});
      growth_(bytes_);
      bytes_.clear();
      given = i + 1;
    }
    std::swap(elements, bytes_);
    counts_.push_back(size);
  }

  /// Of all values that were written, but for the growth.
  const std::string& bytes() const { return bytes_; }
  const GrownCounts& counts() const { return counts_; }  ///< for the next writer

 private:
  static constexpr std::size_t kGrowthAtOnce = 1 << 20;  // bytes

  void put(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }

  template <state::Listed T>
  void write(const T& value) {
    const_cast<T&>(value).state(*this);  // only looks at its members
  }
  template <state::Plain T>
  void write(const T& value) {
    put(&value, sizeof value);
  }
  template <state::Matrix T>
  void write(const T& value) {
    put(value.data(), sizeof(typename T::Scalar) * T::SizeAtCompileTime);
  }
  void write(const Eigen::Isometry3d& value) { write(value.matrix()); }
  void write(const std::string& value) { write_all(value); }
  template <class T>
  void write(const std::vector<T>& values) {
    write_all(values);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    for (const T& value : values) write(value);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class T>
  void write(const std::set<T>& values) {
    write(std::vector<T>(values.begin(), values.end()));
  }
  template <class Key, class T>
  void write(const std::map<Key, T>& values) {
    write(std::uint64_t{values.size()});
    for (const auto& [key, value] : values) (*this)(key, value);
  }
  template <class Values>
  void write_all(const Values& values) {
    write(std::uint64_t{values.size()});
    if constexpr (state::Plain<typename Values::value_type>) {
      put(values.data(), values.size() * sizeof(typename Values::value_type));
    } else {
      for (const auto& value : values) write(value);
    }
  }

  std::string bytes_;
  GrownCounts written_;
  GrowthSink growth_;
  GrownCounts counts_;
};

/// Reads a state from the bytes of a StateWriter, members in the same order.
class StateReader {
 public:
  static constexpr bool kReads = true;

  /// The bytes of a writer, and all growth up to and with its own.
  StateReader(std::string_view bytes, std::string_view growth) : rest_(bytes), growth_(growth) {}

  /// Reads these values.
  template <class... Values>
  void operator()(Values&... values) {
    (read(values), ...);
  }

  /// Reads a container that only grows, whole.
  template <class T>
  void grown(std::vector<T>& values) {
    values.clear();
    grown<T>(
        0, [&](std::size_t) -> const T& { return values.front(); },
        [&](T&& value) { values.push_back(std::move(value)); });
  }

  /// The same for any container: `add(element)` takes the next.
  template <class T, class Get, class Add>
  void grown(std::size_t, Get&&, Add&& add) {
    const std::size_t number = counts_.size();
    counts_.push_back(0);
    const std::string_view bytes = std::exchange(rest_, growth_);
    while (!rest_.empty()) {
      state::Growth head;
      take(&head, sizeof head);
      if (head.bytes > rest_.size()) throw StateError("it ends too early");
      const std::string_view behind = rest_.substr(head.bytes);
      if (head.number == number) {
        for (std::uint64_t i = 0; i < head.elements; ++i) {
          T value;
          read(value);
          add(std::move(value));
        }
        counts_.back() += head.elements;
      }
      rest_ = behind;
    }
    rest_ = bytes;
  }

  const GrownCounts& counts() const { return counts_; }  ///< for the next writer

 private:
  void take(void* to, std::size_t size) {
    if (size > rest_.size()) throw StateError("it ends too early");
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  // Number of elements to come; each takes a byte at least.
  std::size_t size() {
    std::uint64_t size = 0;
    read(size);
    if (size > rest_.size()) throw StateError("it ends too early");
    return size;
  }

  template <state::Listed T>
  void read(T& value) {
    value.state(*this);
  }
  template <state::Plain T>
  void read(T& value) {
    take(&value, sizeof value);
  }
  template <state::Matrix T>
  void read(T& value) {
    take(value.data(), sizeof(typename T::Scalar) * T::SizeAtCompileTime);
  }
  void read(Eigen::Isometry3d& value) { read(value.matrix()); }
  void read(std::string& value) { read_all(value); }
  template <class T>
  void read(std::vector<T>& values) {
    read_all(values);
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    for (T& value : values) read(value);
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool has_value = false;
    read(has_value);
    value.reset();
    if (has_value) read(value.emplace());
  }
  template <class T>
  void read(std::set<T>& values) {
    std::vector<T> all;
    read(all);
    values = {all.begin(), all.end()};
  }
  template <class Key, class T>
  void read(std::map<Key, T>& values) {
    values.clear();
    for (std::size_t left = size(); left > 0; --left) {
      Key key;
      read(key);
      read(values[key]);
    }
  }
  template <class Values>
  void read_all(Values& values) {
    using T = typename Values::value_type;
    const std::size_t count = size();
    values.clear();
    if constexpr (state::Plain<T>) {
      if (count > rest_.size() / sizeof(T)) throw StateError("it ends too early");
      values.resize(count);
      take(values.data(), count * sizeof(T));
    } else {
      for (std::size_t i = 0; i < count; ++i) read(values.emplace_back());
    }
  }

  std::string_view rest_;
  std::string_view growth_;
  GrownCounts counts_;
};

}  // namespace lego_loam_sc

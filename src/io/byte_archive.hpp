// Values as bytes and back, bit for bit: the inside of checkpoints and journals.
//
// A type takes part by one function template that names its fields, used in both directions:
//
//     template <class Archive> void fields(Archive& archive) { archive(first_, second_); }      // member, or
//     template <class Archive> void exchange_fields(Archive& archive, Thing& thing) { ... }     // free, found by ADL
//
// Numbers are stored as they lie in memory (little-endian on every machine we build for). The reader believes no length
// that the remaining bytes cannot hold.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "suture/errors.hpp"

namespace suture {

static_assert(std::endian::native == std::endian::little, "checkpoints and journals are little-endian");

template <class T>
concept PlainNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T, class Archive>
concept HasFields = requires(T& value, Archive& archive) { value.fields(archive); };

class ByteWriter {
 public:
  static constexpr bool reading = false;

  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  void raw(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }
  void put_size(std::size_t size) { put(static_cast<std::uint64_t>(size)); }

  template <PlainNumber T>
  void put(const T& value) {
    raw(&value, sizeof value);
  }
  void put(const std::string& text) { put_size(text.size()), raw(text.data(), text.size()); }
  template <class T>
  void put(const std::vector<T>& values) {
    put_size(values.size());
    if constexpr (PlainNumber<T>)
      raw(values.data(), values.size() * sizeof(T));
    else
      for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class A, class B>
  void put(const std::pair<A, B>& value) {
    put(value.first), put(value.second);
  }
  template <class Key, class T>
  void put(const std::map<Key, T>& values) {
    put_size(values.size());
    for (const auto& entry : values) put(entry);
  }
  template <class... T>
  void put(const std::variant<T...>& value) {
    put(static_cast<std::uint8_t>(value.index()));
    std::visit([this](const auto& alternative) { put(alternative); }, value);
  }
  void put(const std::monostate&) {}
  template <class T>
    requires(std::is_class_v<T>)
  void put(const T& value) {
    T& fields_of = const_cast<T&>(value);  // one function names the fields for both directions; writing changes nothing
    if constexpr (HasFields<T, ByteWriter>)
      fields_of.fields(*this);
    else
      exchange_fields(*this, fields_of);
  }

  std::string bytes_;
};

/// Throws FileError when the bytes end early or cannot mean what they should.
class ByteReader {
 public:
  static constexpr bool reading = true;

  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  bool at_end() const { return bytes_.empty(); }
  void expect_end() const {
    if (!at_end()) throw FileError("there is more data than expected");
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) throw FileError("the data end early");
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }
  /// A number of elements of at least `element` bytes each.
  std::size_t get_size(std::size_t element) {
    std::uint64_t size = 0;
    get(size);
    if (size > bytes_.size() / element) throw FileError("the data claim more elements than they hold");
    return static_cast<std::size_t>(size);
  }

  template <PlainNumber T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      get(byte);
      if (byte > 1) throw FileError("a yes or no is neither");
      value = byte == 1;
    } else {
      std::memcpy(&value, take(sizeof value).data(), sizeof value);
    }
  }
  void get(std::string& text) { text = take(get_size(1)); }
  template <class T>
  void get(std::vector<T>& values) {
    if constexpr (PlainNumber<T>) {
      values.resize(get_size(sizeof(T)));
      const std::string_view source = take(values.size() * sizeof(T));
      if (!source.empty()) std::memcpy(values.data(), source.data(), source.size());
    } else {
      const std::size_t size = get_size(1);
      values.clear();
      for (std::size_t i = 0; i < size; ++i) get(values.emplace_back());
    }
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool present = false;
    get(present);
    value.reset();
    if (!present) return;
    T content{};
    get(content);
    value = std::move(content);
  }
  template <class A, class B>
  void get(std::pair<A, B>& value) {
    get(value.first), get(value.second);
  }
  template <class Key, class T>
  void get(std::map<Key, T>& values) {
    values.clear();
    const std::size_t size = get_size(1);
    for (std::size_t i = 0; i < size; ++i) {
      std::pair<Key, T> entry;
      get(entry);
      values.insert(std::move(entry));
    }
  }
  template <class... T>
  void get(std::variant<T...>& value) {
    std::uint8_t index = 0;
    get(index);
    std::uint8_t candidate = 0;
    const bool known = ((candidate++ == index ? (get(value.template emplace<T>()), true) : false) || ...);
    if (!known) throw FileError("the data hold an alternative that is not known");
  }
  void get(std::monostate&) {}
  template <class T>
    requires(std::is_class_v<T>)
  void get(T& value) {
    if constexpr (HasFields<T, ByteReader>)
      value.fields(*this);
    else
      exchange_fields(*this, value);
  }

  std::string_view bytes_;
};

template <class T>
std::string to_bytes(const T& value) {
  ByteWriter writer;
  writer(value);
  return writer.take();
}

}  // namespace suture

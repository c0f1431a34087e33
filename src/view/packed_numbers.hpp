// Many integers in few bytes: differences, byte planes, zlib, base64. page/numbers.js is the other end.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace suture {

class PackedNumbers {
 public:
  /// Appends a named list. Each number is stored as its difference to the one `stride` places before (to 0 in the first
  /// `stride` places; stride 0: no differences), modulo 2^32.
  void add(const std::string& name, const std::vector<std::int32_t>& numbers, std::size_t stride);
  /// {name: {"offset": in bytes, "count": numbers, "stride": ...}}
  const nlohmann::json& index() const { return index_; }
  /// Everything so far: zlib stream in base64. Throws FileError when zlib fails.
  std::string base64() const;

 private:
  nlohmann::json index_ = nlohmann::json::object();
  std::vector<unsigned char> bytes_;
};

}  // namespace suture

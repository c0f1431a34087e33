#include "view/packed_numbers.hpp"

#include <zlib.h>

#include "suture/errors.hpp"
#include "suture/io/base64.hpp"

namespace suture {
namespace {

// 0, -1, 1, -2, ... become 0, 1, 2, 3, ...: small differences of either sign have empty upper bytes.
std::uint32_t zigzag(std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  return bits << 1 ^ (value < 0 ? 0xffffffffu : 0u);
}

}  // namespace

void PackedNumbers::add(const std::string& name, const std::vector<std::int32_t>& numbers, std::size_t stride) {
  const std::size_t count = numbers.size(), offset = bytes_.size();
  index_[name] = {{"offset", offset}, {"count", count}, {"stride", stride}};
  bytes_.resize(offset + 4 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t before = stride > 0 && i >= stride ? numbers[i - stride] : 0;
    const auto difference = static_cast<std::int32_t>(static_cast<std::uint32_t>(numbers[i]) - static_cast<std::uint32_t>(before));
    const std::uint32_t code = zigzag(difference);
    for (std::size_t plane = 0; plane < 4; ++plane)
      bytes_[offset + plane * count + i] = static_cast<unsigned char>(code >> 8 * plane);
  }
}

std::string PackedNumbers::base64() const {
  uLongf size = compressBound(bytes_.size());
  std::vector<std::byte> packed(size);
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_.data(), bytes_.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw FileError("the data of the page could not be compressed");
  return suture::base64(std::span(packed).first(size));
}

}  // namespace suture

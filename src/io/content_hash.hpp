// Fingerprints that tell damaged bytes from good ones. XXH3, 64 bits (libxxhash): for accidents, not against forgery.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace suture {

std::uint64_t content_hash(std::span<const std::byte> bytes, std::uint64_t seed = 0);

inline std::uint64_t content_hash(std::string_view text, std::uint64_t seed = 0) {
  return content_hash(std::as_bytes(std::span(text.data(), text.size())), seed);
}

}  // namespace suture

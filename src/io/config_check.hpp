// Checks that involve more than one key.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "suture/model/parameters.hpp"

namespace suture {

/// Where a key was given: "embryo.toml:12:7", or what to say when it was not.
using OriginOf = std::function<std::string(std::string_view key)>;

/// Throws InputError "origin: key 'x.y': found ..., allowed ...".
void check_config(const Config& config, const OriginOf& origin_of);

}  // namespace suture

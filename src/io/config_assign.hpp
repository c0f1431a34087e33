// Checks one located value against its row of the table and stores it.
#pragma once

#include "config_document.hpp"
#include "suture/io/config_key.hpp"

namespace suture {

/// Throws InputError "origin: key 'x.y': found ..., allowed ...". `alias` is the second spelling used, or null.
void assign(const KeyDescription& key, const Slot& slot, const Alias* alias, const ConfigEntry& entry,
            const UnitScales& scales);

}  // namespace suture

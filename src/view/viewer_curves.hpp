// The course of the run around the frames: curves, events, milestones, and what was run.
#pragma once

#include <nlohmann/json.hpp>

#include "suture/replay/replay.hpp"

namespace suture {

/// Since the time origin of the replay, rounded to what a page can show.
double minutes(const Replay& replay, double time);

/// Adds "curves", "events", "milestones" and "facts".
void add_run_story(const Replay& replay, nlohmann::json& description);

}  // namespace suture

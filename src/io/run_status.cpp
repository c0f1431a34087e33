#include "suture/io/run_status.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/checkpoint_file.hpp"
#include "suture/errors.hpp"
#include "suture/io/provenance.hpp"
#include "suture/io/trajectory.hpp"

namespace suture {
namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path status_path(const std::filesystem::path& directory) { return directory / "status.json"; }

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  if (seconds < 172800.0) return fmt::format("{:.1f} h", seconds / 3600.0);
  return fmt::format("{:.1f} d", seconds / 86400.0);
}

Json read_json(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  return Json::parse(text, nullptr, /*allow_exceptions=*/false);
}

template <class Value>
Value field(const Json& json, const char* name, Value fallback) {
  const auto found = json.find(name);
  if (found == json.end()) return fallback;
  if constexpr (std::is_same_v<Value, std::string>)
    return found->is_string() ? found->template get<Value>() : fallback;
  else
    return found->is_number() ? found->template get<Value>() : fallback;
}

bool process_is_gone(const Json& note) {
  const int process = field(note, "process", 0);
  return process > 0 && field<std::string>(note, "host", "") == host_name() && ::kill(process, 0) != 0 && errno == ESRCH;
}

std::string finished_text(const Json& summary) {
  const auto time = [&](const char* key) {
    const double value = field(summary, key, std::nan(""));
    return std::isnan(value) ? std::string("never") : fmt::format("{:.4g}", value);
  };
  return fmt::format("finished: {}\n  wound closed at t = {}, half closed at {}\n", field<std::string>(summary, "status", "?"),
                     time("t_closed"), time("t_50"));
}

}  // namespace

void write_status(const std::filesystem::path& directory, const RunStatusNote& note) {
  Json json;
  json["state"] = note.state;
  json["stage"] = note.stage;
  json["fraction"] = note.fraction;
  json["text"] = note.text;
  json["wall_s"] = note.wall_s;
  json["eta_s"] = note.eta_s ? Json(*note.eta_s) : Json(nullptr);
  json["updated"] = utc_now();
  json["host"] = host_name();
  json["process"] = static_cast<int>(::getpid());
  const std::filesystem::path temporary = temporary_beside(status_path(directory));
  std::ofstream(temporary, std::ios::binary) << json.dump(2) << '\n';
  std::error_code ignored;
  std::filesystem::rename(temporary, status_path(directory), ignored);
}

void remove_status(const std::filesystem::path& directory) {
  std::error_code ignored;
  std::filesystem::remove(status_path(directory), ignored);
}

DirectoryStatus describe_run(const std::filesystem::path& directory) {
  if (!std::filesystem::is_directory(directory)) throw InputError(fmt::format("{}: no such folder", directory.string()));
  const bool unfinished = std::filesystem::exists(journal_path(directory / "run.h5"));
  const Json summary = read_json(directory / "summary.json"), note = read_json(status_path(directory));
  const std::string name = directory.string();
  if (!unfinished) {
    if (!summary.is_object()) throw InputError(fmt::format("{}: holds no run (neither run.journal nor summary.json)", name));
    return {fmt::format("{}: {}", name, finished_text(summary)), false};
  }
  const bool stopped = note.is_object() && field<std::string>(note, "state", "") == "stopped";
  const bool killed = note.is_object() && !stopped && process_is_gone(note);
  std::string text = fmt::format("{}: {}\n", name, stopped ? "stopped" : killed ? "killed" : "running");
  if (note.is_object()) {
    text += fmt::format("  {} {:.1f} %: {}\n", field<std::string>(note, "stage", "?"), 100.0 * field(note, "fraction", 0.0),
                        field<std::string>(note, "text", ""));
    text += fmt::format("  {} of wall time", duration_text(field(note, "wall_s", 0.0)));
    const double eta = field(note, "eta_s", std::nan(""));
    if (!stopped && !killed && !std::isnan(eta)) text += fmt::format(", about {} left in this stage", duration_text(eta));
    text += fmt::format("; last sign {} from process {} on {}\n", field<std::string>(note, "updated", "?"),
                        field(note, "process", 0), field<std::string>(note, "host", "?"));
  }
  if (stopped || killed) {
    const bool saved = std::filesystem::exists(checkpoint_path(directory)) || std::filesystem::exists(previous_checkpoint_path(directory));
    text += saved ? "  suture run CONFIG --out DIR --resume continues from its checkpoint\n"
                  : "  there is no checkpoint yet: --resume starts from the beginning\n";
  }
  return {text, !stopped && !killed};
}

}  // namespace suture

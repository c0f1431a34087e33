#include "suture/sweep/sweep_run.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/simulate/run.hpp"
#include "suture/sweep/claim.hpp"
#include "suture/sweep/preparation_cache.hpp"
#include "suture/version.hpp"

namespace suture {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>{stream}, {}};
}

std::string commit() { return fmt::format("{}{}", build_information().commit, build_information().dirty ? "-dirty" : ""); }

void write_record(const SweepFolder& folder, const SweepRun& run, const RunRecord& record) {
  const nlohmann::ordered_json json = {{"status", record.status},
                                       {"reason", record.reason},
                                       {"code_version", build_information().version},
                                       {"code_commit", record.commit},
                                       {"finished", utc_now()}};
  // A log of what was executed; one write of one line, so that lines of several workers do not mix.
  std::ofstream(folder.root / "log.txt", std::ios::app) << fmt::format("{} {} {} {}\n", utc_now(), run.key, run.index, record.status) << std::flush;
  write_file_atomically(folder.run(run) / "done.json", json.dump(2) + "\n");
}

RunOutcome simulate(const SweepFolder& folder, const SweepRun& run, const std::function<bool()>& stop) {
  Config config = run.config;
  if (can_share_preparation(config))
    config.run.start_from = shared_preparation(run.preparation.value_or(run.config), folder.prepared(), folder.lease_s, stop).string();
  return run_protocol({config, provenance_of(config, run.text(), fmt::format("suture sweep, run {} ({})", run.index, run.key)), folder.run(run), {}, stop});
}

const char* status_name(RunStatus status) {
  switch (status) {
    case RunStatus::closed: return "closed";
    case RunStatus::reached_t_end: return "reached_t_end";
    default: return "failed";
  }
}

void start_afresh(const SweepFolder& folder, const SweepRun& run) {
  fs::remove_all(folder.run(run));
  fs::create_directories(folder.run(run));
  write_file_atomically(folder.run(run) / "config.toml", run.text());
}

}  // namespace

void SweepFolder::create() const {
  std::error_code error;
  for (const fs::path& folder : {root / "runs", prepared(), claims()})
    if (!fs::create_directories(folder, error) && error)
      throw FileError(fmt::format("{}: cannot create: {}", folder.string(), error.message()));
}

std::optional<RunRecord> finished_record(const SweepFolder& folder, const SweepRun& run) {
  const fs::path file = folder.run(run) / "done.json";
  if (!fs::exists(file)) return std::nullopt;
  if (text_of(folder.run(run) / "config.toml") != run.text())
    throw FileError(fmt::format("{}: holds another configuration than run {} of the sweep", folder.run(run).string(), run.index));
  try {
    const nlohmann::json json = nlohmann::json::parse(text_of(file));
    return RunRecord{json.at("status"), json.at("reason"), json.at("code_commit")};
  } catch (const nlohmann::json::exception& error) {
    throw FileError(fmt::format("{}: not readable ({}); remove it to repeat the run", file.string(), error.what()));
  }
}

void record_failure(const SweepFolder& folder, const SweepRun& run, const std::string& reason) {
  std::optional<Claim> claim = Claim::take(folder.claims(), run.key, folder.lease_s);
  if (!claim || finished_record(folder, run)) return;
  start_afresh(folder, run);
  write_record(folder, run, {"failed", reason, commit()});
  claim->finish();
}

RunEnd execute_run(const SweepFolder& folder, const SweepRun& run, const std::function<bool()>& stop) {
  std::optional<Claim> claim = Claim::take(folder.claims(), run.key, folder.lease_s);
  // Looked at after the claim: its last holder may have finished meanwhile.
  if (finished_record(folder, run)) {
    if (claim) claim->finish();
    return RunEnd::finished;
  }
  if (!claim) return RunEnd::busy;
  start_afresh(folder, run);
  RunRecord record{"failed", {}, commit()};
  try {
    const RunOutcome outcome = simulate(folder, run, stop);
    if (outcome.summary.status == RunStatus::stopped) return RunEnd::stopped;
    record.status = status_name(outcome.summary.status);
    record.reason = outcome.failure;
  } catch (const PreparationStopped&) {
    return RunEnd::stopped;
  } catch (const InputError& error) {
    record.reason = error.what();
  } catch (const NumericalError& error) {
    record.reason = error.what();
  }
  write_record(folder, run, record);
  claim->finish();
  return RunEnd::finished;
}

}  // namespace suture

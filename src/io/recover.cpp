#include "suture/io/recover.hpp"

#include <fmt/format.h>

#include "io/checkpoint_file.hpp"
#include "io/journal.hpp"
#include "io/trajectory_file.hpp"
#include "suture/errors.hpp"
#include "suture/io/units.hpp"

namespace suture {
namespace {

std::string checkpoint_report(const std::filesystem::path& path) {
  try {
    read_checkpoint(path);
    return fmt::format("  {}: good\n", path.filename().string());
  } catch (const FileError& error) {
    return std::filesystem::exists(path) ? fmt::format("  {}\n", error.what()) : std::string();
  }
}

}  // namespace

std::string recover_run(const std::filesystem::path& directory) {
  const std::filesystem::path trajectory = directory / "run.h5", journal = journal_path(trajectory);
  if (!std::filesystem::exists(journal))
    throw InputError(fmt::format("{}: there is no run.journal: no run was interrupted here{}", directory.string(),
                                 std::filesystem::exists(trajectory) ? " (run.h5 is what 'suture check' says it is)" : ""));
  const Recovered recovered = recover_journal(journal, trajectory);
  write_wound_csv(recovered.samples, UnitScales(recovered.units), directory / "wound.csv");
  std::string text = fmt::format("{}: recovered {} frames, {} samples, until t = {:.6g} -> run.h5, wound.csv\n",
                                 directory.string(), recovered.frames, recovered.samples.size(), recovered.last_time);
  if (recovered.lost_bytes > 0)
    text += fmt::format("  {} of {} bytes of run.journal were damaged or incomplete and are left out\n", recovered.lost_bytes,
                        recovered.journal_bytes);
  text += checkpoint_report(checkpoint_path(directory)) + checkpoint_report(previous_checkpoint_path(directory));
  return text;
}

}  // namespace suture

// suture export RUN.h5 --format xdmf|vtp --out DIR: a finished run for ParaView and VisIt.
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/export/export.hpp"
#include "suture/replay/choose_frames.hpp"

namespace suture {

namespace {

struct Options {
  std::string run, format, directory, frames = "all", units = "model";
};

void export_run(const Options& options) {
  const Replay replay(options.run);
  const ExportRequest request{choose_frames(options.frames, replay.frame_count()),
                              options.units == "model" ? ExportUnits::model : ExportUnits::physical};
  const auto files = options.format == "xdmf" ? export_xdmf(replay, request, options.directory)
                                              : export_vtp(replay, request, options.directory);
  for (const auto& file : files) std::cout << file.string() << "\n";
}

}  // namespace

void add_export_command(CLI::App& program, CommandResult&) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("export", "a finished run for ParaView and VisIt");
  command->add_option("RUN.h5", options->run, "the run")->required();
  command->add_option("--format", options->format, "xdmf (one HDF5 file) or vtp (a file per frame)")
      ->required()
      ->check(CLI::IsMember({"xdmf", "vtp"}));
  command->add_option("--out", options->directory, "folder for the files (created)")->required();
  command->add_option("--frames", options->frames, "all, last, or numbers and ranges: 0,10,20 or 0:100:5")
      ->capture_default_str();
  command->add_option("--units", options->units, "model, or physical: um, min, nN")
      ->check(CLI::IsMember({"model", "physical"}))
      ->capture_default_str();
  command->callback([options] { export_run(*options); });
}

}  // namespace suture

// suture view RUN.h5 --out view.html: a web page that plays a finished run.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/view/view_page.hpp"

namespace suture {

namespace {

struct Options {
  std::string run, page = "view.html", title;
  int maximum_frames = 1000;
};

/// "embryo / seed1" of /campaign/embryo/seed1/run.h5.
std::string title_of(const std::string& run) {
  const std::filesystem::path folder = std::filesystem::absolute(run).lexically_normal().parent_path();
  const std::string parent = folder.parent_path().filename().string(), own = folder.filename().string();
  return parent.empty() ? own : parent + " / " + own;
}

void view(const Options& options) {
  const Replay replay(options.run);
  const ViewRequest request{options.title.empty() ? title_of(options.run) : options.title, options.maximum_frames};
  const ViewPage page = write_view_page(replay, request, options.page);
  std::cout << fmt::format("{}: {} of {} frames, {:.1f} MB\n", options.page, page.frames, replay.frame_count(),
                           1e-6 * static_cast<double>(page.bytes));
  if (replay.frame_count() < 25)
    std::cerr << fmt::format("suture: note: the run has {} frames, between which the page interpolates; runs with a "
                             "smaller output.frame_interval store more\n", replay.frame_count());
}

}  // namespace

void add_view_command(CLI::App& program, CommandResult&) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("view", "a web page that plays a finished run");
  command->add_option("RUN.h5", options->run, "the run")->required();
  command->add_option("--out", options->page, "the page, one file")->capture_default_str();
  command->add_option("--title", options->title, "of the page (default: the folder of the run)");
  command->add_option("--max-frames", options->maximum_frames, "of a longer run so many are taken, evenly spread")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->callback([options] { view(*options); });
}

}  // namespace suture

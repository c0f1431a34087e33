// suture render RUN.h5: pictures, movies and time strips of a finished run.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/errors.hpp"
#include "suture/render/run_pictures.hpp"
#include "suture/replay/choose_frames.hpp"

namespace suture {

namespace {

struct Options {
  std::string run, directory, field = "shape_parameter", frames = "all", movie, strip;
  std::vector<std::string> formats{"png"};
  std::vector<double> range;
  int size = 1000, frames_per_second = 25, panels = 5;
  bool formats_given = false;
};

void render(const Options& options) {
  const Replay replay(options.run);
  PictureRequest request{.field = options.field,
                         .frames = choose_frames(options.frames, replay.frame_count()),
                         .size = options.size,
                         .range = {}};
  if (!options.range.empty()) request.range = {options.range[0], options.range[1]};
  const RunPictures pictures(replay, request);
  const std::size_t count = request.frames.size();
  // Stills are what is meant when nothing else is asked for.
  if (!options.directory.empty() || options.formats_given || (options.movie.empty() && options.strip.empty())) {
    const std::string directory = options.directory.empty() ? "frames" : options.directory;
    const int files = pictures.write_stills(directory, options.formats);
    std::cout << fmt::format("{} pictures in {}\n", files, directory);
  }
  if (!options.strip.empty()) {
    pictures.write_strip(options.strip, options.panels);
    std::cout << options.strip << "\n";
  }
  if (!options.movie.empty()) {
    pictures.write_movie(options.movie, options.frames_per_second);
    std::cout << fmt::format("{}: {} frames, {:.1f} s\n", options.movie, count,
                             static_cast<double>(count) / options.frames_per_second);
    if (count < 25)
      std::cerr << fmt::format("suture: note: the movie has {} frames; runs with a smaller output.frame_interval store "
                               "more\n", count);
  }
}

}  // namespace

void add_render_command(CLI::App& program, CommandResult&) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("render", "pictures, movies and strips of a finished run");
  command->add_option("RUN.h5", options->run, "the run")->required();
  command->add_option("--out", options->directory, "folder for stills, frame_0000.png ... (default: frames)");
  command->add_option("--field", options->field,
                      "of cells: shape_parameter, area_strain, area, perimeter, contacts; of membranes: "
                      "membrane_tension, rest_length_strain")
      ->capture_default_str();
  command->add_option("--frames", options->frames, "all, last, or numbers and ranges: 0,10,20 or 0:100:5")
      ->capture_default_str();
  CLI::Option* const format =
      command->add_option("--format", options->formats, "of the stills: png, svg, pdf, separated by commas")
          ->delimiter(',')
          ->check(CLI::IsMember({"png", "svg", "pdf"}));
  command->add_option("--movie", options->movie, "film of the frames, .mp4 or .webm (needs ffmpeg)");
  command->add_option("--fps", options->frames_per_second, "frames per second of the film")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--strip", options->strip, "one picture of several times side by side, .png, .svg or .pdf");
  command->add_option("--panels", options->panels, "of the strip")->check(CLI::Range(1, 26))->capture_default_str();
  command->add_option("--size", options->size, "pixels of a still, a film or a panel")
      ->check(CLI::Range(64, 16384))
      ->capture_default_str();
  command->add_option("--range", options->range, "MIN,MAX of the colour bar (default: from the frames)")
      ->delimiter(',')
      ->expected(2);
  command->callback([options, format] {
    options->formats_given = format->count() > 0;
    render(*options);
  });
}

}  // namespace suture

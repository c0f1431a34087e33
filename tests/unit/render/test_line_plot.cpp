// Plots come out whole, whatever the data.
#include <catch2/catch.hpp>
#include <filesystem>
#include <cmath>

#include "support/program.hpp"
#include "suture/errors.hpp"
#include "suture/render/line_plot.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("a plot shows curves, guides and legend, and leaves out what a logarithm cannot show", "[unit]") {
  const TemporaryDirectory directory;
  PlotPanel panel{"Title", "error", "seconds", {{"cvode", 0, {{1e-3, 0.5}, {1e-4, 1.0}}}, {"euler", 1, {{0.0, 1.0}, {1e-2, NAN}, {1e-2, 5.0}}}}};
  panel.diagonal = true;
  panel.vertical = 2e-4, panel.vertical_label = "uncertain";
  const std::vector<PlotPanel> panels{panel, {"Empty", "x", "y", {}}};
  for (const char* name : {"plot.png", "plot.svg"}) {
    const std::filesystem::path path = directory.path() / name;
    render_plots(panels, path);
    CHECK(std::filesystem::file_size(path) > 1000);
  }
  const std::vector<PlotPanel> other{panels[1], panels[1]};
  render_plots(other, directory.path() / "empty.svg");
  CHECK(std::filesystem::file_size(directory.path() / "empty.svg") < std::filesystem::file_size(directory.path() / "plot.svg"));
  CHECK_THROWS_AS(render_plots(panels, directory.path() / "plot.gif"), InputError);
}

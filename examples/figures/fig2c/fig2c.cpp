// Fig. 2c: an elastic and a plastic cell, compressed between two plates and released; the two examples of this repository.
#include "../csv.hpp"
#include "suture/io/config.hpp"
#include "suture/simulate/cell_experiment.hpp"

using namespace suture;
using namespace suture::figures;

namespace {

void write_outline(CsvFile& file, const std::string& cell, const char* stage, const TissueState& state) {
  const StateView view = state.view();
  for (int v = 0; v < state.tissue.vertex_count(); ++v) file.row(cell, stage, state.time, v, view.x[v], view.y[v]);
}

}  // namespace

int main(int argc, char** argv) {
  return figure_main(argc, argv, [](const auto& out, const auto& published, const auto&) {
    const std::filesystem::path examples = published / "../../examples";
    CsvFile outlines(out / "outlines.csv", "cell,stage,time,vertex,x,y");
    CsvFile course(out / "course.csv", "cell,tau_over_T,time,shape_parameter,area");
    for (const std::string cell : {"elastic", "plastic"}) {
      const Config config = read_config(examples / ("compression_" + cell + ".toml"));
      const CellExperimentResult result = run_cell_experiment(config);
      if (result.failure) throw NumericalError(*result.failure);
      write_outline(outlines, cell, "before", result.frames.front());
      write_outline(outlines, cell, "compressed", result.frames[*result.release_frame]);
      write_outline(outlines, cell, "released", result.frames.back());
      for (const CellSample& sample : result.samples)
        course.row(cell, config.plasticity.tau / config.compression.duration, sample.time, sample.shape_parameter, sample.area);
    }
  });
}

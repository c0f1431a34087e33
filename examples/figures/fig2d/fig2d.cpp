// Fig. 2d: the wounded monolayer with its purse string a little while after the string has formed; the embryo example.
//   fig2d OUTPUT_FOLDER PUBLISHED_FOLDER [TIME]      TIME: since the string formed, model units (default 5)
#include <cmath>

#include "../csv.hpp"
#include "suture/io/config.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/closure.hpp"

using namespace suture;
using namespace suture::figures;

namespace {

class Nobody final : public ClosureObserver {
 public:
  void sample(const ClosureSample&) override {}
  void event(const EventRecord&) override {}
};

const char* word(TetherMode mode) { return mode == TetherMode::attached ? "attached" : "slipped"; }

void write_state(const std::filesystem::path& out, const TissueState& state) {
  const StateView view = state.view();
  CsvFile cells(out / "cells.csv", "cell,vertex,x,y");
  for (int v = 0; v < state.tissue.vertex_count(); ++v) cells.row(state.tissue.cell_of(v), v, view.x[v], view.y[v]);
  CsvFile string(out / "string.csv", "vertex,x,y,tethered_x,tethered_y,mode,tension");
  const PurseString& ring = state.purse_string;
  const int first = state.tissue.vertex_count(), n = ring.size();
  for (int j = 0; j < n; ++j) {
    const int v = ring.vertex[j], here = first + j, next = first + (j + 1) % n;
    const double length = std::hypot(view.x[next] - view.x[here], view.y[next] - view.y[here]);
    const double reference = ring.spring[j].reference_length;  // of the quadratic law, which the example has
    const double tension = (length - ring.rest_length(j, state.time)) / (reference * reference);
    string.row(v, view.x[here], view.y[here], view.x[v], view.y[v], word(ring.mode[j]), tension);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return figure_main(argc, argv, [](const auto& out, const auto& published, const auto& more) {
    Config config = with_contact_distance(read_config(published / "../../examples/embryo.toml"));
    config.run.end_time = more.empty() ? 5.0 : std::stod(more.front());
    Preparation prepared = prepare_tissue(config);
    Nobody nobody;
    TissueState last_good;
    write_state(out, run_closure(config, std::move(prepared.state), nobody, last_good).state);
    CsvFile(out / "parameters.csv", "time,contact_distance,seed").row(config.run.end_time, *config.contact.distance, config.tissue.seed);
  });
}

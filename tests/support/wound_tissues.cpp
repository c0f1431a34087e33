#include "support/wound_tissues.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace suture::test {

Membrane default_membrane() { return {.contact_distance = 0.12967913341208, .range = 0.3}; }

TissueState tissue_of(const std::vector<Polygon>& cells) {
  std::vector<int> counts;
  std::vector<double> x, y, rest;
  for (const Polygon& cell : cells) {
    counts.push_back(static_cast<int>(cell.size()));
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Point next = cell[(i + 1) % cell.size()];
      x.push_back(cell[i].x), y.push_back(cell[i].y);
      rest.push_back(std::hypot(next.x - cell[i].x, next.y - cell[i].y));
    }
  }
  TissueState state;
  state.tissue = Tissue(counts, std::vector<CellMaterial>(cells.size()), rest);
  state.values = x;
  state.values.insert(state.values.end(), y.begin(), y.end());
  state.values.insert(state.values.end(), rest.begin(), rest.end());
  return state;
}

std::vector<Polygon> sector_ring(const SectorRing& ring) {
  std::vector<Polygon> cells;
  const auto at = [](double r, double angle) { return Point{r * std::cos(angle), r * std::sin(angle)}; };
  for (int c = 0; c < ring.cells; ++c) {
    const double low = 2.0 * std::numbers::pi * c / ring.cells, high = 2.0 * std::numbers::pi * (c + 1) / ring.cells;
    // Half the gap is taken off each side wall, at right angles to it.
    const auto angle = [&](double fraction, double r) {
      const double inset = std::asin(0.5 * ring.gap / r);
      return low + inset + fraction * (high - low - 2.0 * inset);
    };
    Polygon cell;
    const double corner = angle(0.0, ring.inner(low));
    cell.push_back(at(ring.inner(corner), corner));
    for (int i = 1; i <= ring.side_points; ++i) {
      const double f = static_cast<double>(i) / (ring.side_points + 1);
      const double r = ring.inner(low) + f * (ring.outer(low) - ring.inner(low));
      cell.push_back(at(r, angle(0.0, r)));
    }
    for (int i = 0; i < ring.inner_points; ++i) {
      const double f = static_cast<double>(i) / (ring.inner_points - 1), a = angle(f, ring.outer(low));
      cell.push_back(at(ring.outer(a), a));
    }
    for (int i = ring.side_points; i >= 1; --i) {
      const double f = static_cast<double>(i) / (ring.side_points + 1);
      const double r = ring.inner(high) + f * (ring.outer(high) - ring.inner(high));
      cell.push_back(at(r, angle(1.0, r)));
    }
    for (int i = ring.inner_points - 1; i >= 1; --i) {
      const double f = static_cast<double>(i) / (ring.inner_points - 1), a = angle(f, ring.inner(low));
      cell.push_back(at(ring.inner(a), a));
    }
    cells.push_back(cell);
  }
  return cells;
}

std::vector<Polygon> honeycomb(const Honeycomb& h) {
  std::vector<Polygon> cells;
  const double corner = (h.spacing - h.gap) / std::sqrt(3.0);
  for (int a = -h.rings; a <= h.rings; ++a)
    for (int b = std::max(-h.rings, -h.rings - a); b <= std::min(h.rings, h.rings - a); ++b) {
      const Point site{h.spacing * (a + 0.5 * b), h.spacing * 0.5 * std::sqrt(3.0) * b};
      if (h.removed(site)) continue;
      Polygon cell;
      for (int side = 0; side < 6; ++side)
        for (int i = 0; i < h.points_per_side; ++i) {
          const double f = static_cast<double>(i) / h.points_per_side;
          const double low = std::numbers::pi * (side / 3.0 + 1.0 / 6.0), high = low + std::numbers::pi / 3.0;
          cell.push_back({site.x + corner * ((1.0 - f) * std::cos(low) + f * std::cos(high)),
                          site.y + corner * ((1.0 - f) * std::sin(low) + f * std::sin(high))});
        }
      cells.push_back(cell);
    }
  return cells;
}

TissueState wounded_honeycomb(double noise, unsigned seed) {
  // 61 sites; the six corners and five more of the outer ring go, to leave 50 cells, five of which are the wound.
  const auto removed = [](Point p) {
    const bool wound = std::hypot(p.x - 0.3, p.y - 0.6) < 1.3;
    const bool corner = std::hypot(p.x, p.y) > 4.2;
    return wound || corner;
  };
  TissueState state = tissue_of(honeycomb({.removed = removed}));
  shake(state, noise, seed);
  return state;
}

std::vector<int> vertices_inside_other_cells(const TissueState& state) {
  const StateView view = state.view();
  std::vector<int> found;
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    Polygon outline;
    for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v) outline.push_back({view.x[v], view.y[v]});
    for (int v = 0; v < state.tissue.vertex_count(); ++v)
      if (state.tissue.cell_of(v) != cell && contains(outline, {view.x[v], view.y[v]})) found.push_back(v);
  }
  return found;
}

void shake(TissueState& state, double amplitude, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  const MutableStateView view = state.mutable_view();
  for (double& x : view.x) x += uniform(engine);
  for (double& y : view.y) y += uniform(engine);
}

void move(TissueState& state, double angle, double dx, double dy) {
  const MutableStateView view = state.mutable_view();
  for (std::size_t i = 0; i < view.x.size(); ++i) {
    const double x = view.x[i], y = view.y[i];
    view.x[i] = std::cos(angle) * x - std::sin(angle) * y + dx;
    view.y[i] = std::sin(angle) * x + std::cos(angle) * y + dy;
  }
}

TissueState renumbered(const TissueState& state, unsigned seed, std::vector<int>& new_vertex) {
  std::mt19937 engine(seed);
  std::vector<int> order(state.tissue.cell_count());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), engine);
  new_vertex.resize(state.tissue.vertex_count());
  std::vector<Polygon> cells;
  int next = 0;
  for (const int cell : order) {
    const int first = state.tissue.first_vertex(cell), count = state.tissue.vertex_count(cell);
    const int turn = static_cast<int>(engine() % count);
    Polygon polygon;
    for (int i = 0; i < count; ++i) {
      const int v = first + (i + turn) % count;
      new_vertex[v] = next++;
      polygon.push_back({state.view().x[v], state.view().y[v]});
    }
    cells.push_back(polygon);
  }
  return tissue_of(cells);
}

namespace {

class Pixels {
 public:
  Pixels(const TissueState& state, double pixel, double border) : pixel_(pixel) {
    const StateView view = state.view();
    const auto [xl, xh] = std::minmax_element(view.x.begin(), view.x.end());
    const auto [yl, yh] = std::minmax_element(view.y.begin(), view.y.end());
    x0_ = *xl - border, y0_ = *yl - border;
    columns_ = static_cast<int>((*xh - *xl + 2 * border) / pixel) + 1;
    rows_ = static_cast<int>((*yh - *yl + 2 * border) / pixel) + 1;
    open.assign(static_cast<std::size_t>(columns_) * rows_, 1);
  }
  Point centre(int i, int j) const { return {x0_ + (i + 0.5) * pixel_, y0_ + (j + 0.5) * pixel_}; }
  int column(double x) const { return static_cast<int>(std::floor((x - x0_) / pixel_)); }
  int row(double y) const { return static_cast<int>(std::floor((y - y0_) / pixel_)); }
  bool valid(int i, int j) const { return i >= 0 && j >= 0 && i < columns_ && j < rows_; }
  int index(int i, int j) const { return j * columns_ + i; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

  template <typename Do>
  void around(Point p, double radius, Do&& act) const {
    for (int j = std::max(0, row(p.y - radius)); j <= std::min(rows_ - 1, row(p.y + radius)); ++j)
      for (int i = std::max(0, column(p.x - radius)); i <= std::min(columns_ - 1, column(p.x + radius)); ++i) act(i, j);
  }

  std::vector<char> open;

 private:
  double pixel_, x0_, y0_;
  int columns_, rows_;
};

void close_cell(Pixels& pixels, const Polygon& cell, double rho) {
  const BoundingBox box = bounding_box(cell);
  const Point middle{0.5 * (box.x_low + box.x_high), 0.5 * (box.y_low + box.y_high)};
  const double reach = 0.5 * std::max(box.x_high - box.x_low, box.y_high - box.y_low) + rho;
  pixels.around(middle, reach, [&](int i, int j) {
    if (contains(cell, pixels.centre(i, j))) pixels.open[pixels.index(i, j)] = 0;
  });
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Polygon segment{cell[k], cell[(k + 1) % cell.size()]};
    const Point mid{0.5 * (segment[0].x + segment[1].x), 0.5 * (segment[0].y + segment[1].y)};
    const double half = 0.5 * std::hypot(segment[1].x - segment[0].x, segment[1].y - segment[0].y);
    pixels.around(mid, half + rho, [&](int i, int j) {
      if (squared_distance_to_outline(segment, pixels.centre(i, j)) <= rho * rho) pixels.open[pixels.index(i, j)] = 0;
    });
  }
}

std::vector<std::pair<int, int>> flood(Pixels& pixels, Point start) {
  std::vector<std::pair<int, int>> flooded;
  const auto fill = [&](int i, int j) {
    if (!pixels.valid(i, j) || pixels.open[pixels.index(i, j)] != 1) return;
    pixels.open[pixels.index(i, j)] = 2;
    flooded.emplace_back(i, j);
  };
  const int ci = pixels.column(start.x), cj = pixels.row(start.y);
  for (int ring = 0; ring <= 2 && flooded.empty(); ++ring)
    for (int j = cj - ring; j <= cj + ring && flooded.empty(); ++j)
      for (int i = ci - ring; i <= ci + ring && flooded.empty(); ++i) fill(i, j);
  for (std::size_t k = 0; k < flooded.size(); ++k) {
    const auto [i, j] = flooded[k];
    fill(i - 1, j), fill(i + 1, j), fill(i, j - 1), fill(i, j + 1);
  }
  return flooded;
}

}  // namespace

double flood_fill_area(const TissueState& state, const Membrane& membrane, Point start, double pixel) {
  const double rho = membrane.probe_radius(), regrow = rho - membrane.half_width();
  Pixels pixels(state, pixel, 2.0 * rho + 2.0 * pixel);
  const StateView view = state.view();
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    Polygon polygon;
    for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v)
      polygon.push_back({view.x[v], view.y[v]});
    close_cell(pixels, polygon, rho);
  }
  std::vector<char> counted(pixels.open.size(), 0);
  long count = 0;
  const auto add = [&](int i, int j) { count += 1 - counted[pixels.index(i, j)], counted[pixels.index(i, j)] = 1; };
  for (const auto& [i, j] : flood(pixels, start)) {
    add(i, j);
    const Point p = pixels.centre(i, j);
    pixels.around(p, regrow, [&](int k, int l) {
      const Point q = pixels.centre(k, l);
      if (std::hypot(q.x - p.x, q.y - p.y) <= regrow) add(k, l);
    });
  }
  return static_cast<double>(count) * pixel * pixel;
}

}  // namespace suture::test

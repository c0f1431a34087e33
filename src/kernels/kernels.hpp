// The hot loops of the tissue, compiled once per instruction set and chosen at run time.
//
// Every cell owns a padded run of slots: slot 0 repeats the last vertex, slots 1..n are the vertices, and the slots
// after them repeat the first ones, so that neighbours along the membrane and windows of eight consecutive vertices
// are plain contiguous loads:
//
//     base + 0        : vertex n-1
//     base + 1 + i    : vertex i
//     base + 1 + n + i: vertex i again, i < 9
//
// Segment quantities at a slot belong to the segment from that vertex to the next.
#pragma once

#include <cstddef>
#include <cstdint>

namespace suture::kernels {

constexpr int halo = 10;  ///< padded slots of a cell beyond its vertices

/// Membrane, bending and area of all cells. Arrays of slots unless noted.
struct Shell {
  int cells = 0;
  const int* base = nullptr;   ///< first slot of each cell
  const int* count = nullptr;  ///< vertices of each cell
  bool relative_law = false;
  const double *rest_area = nullptr, *area_stiffness = nullptr, *bending_stiffness = nullptr;  ///< per cell
  double *x = nullptr, *y = nullptr;
  double *ex = nullptr, *ey = nullptr, *length = nullptr, *inverse_length = nullptr;
  double *theta = nullptr;
  /// Rest length as a function of the length, l0 = rest_a + rest_b l: rest_b = 0 in a plain rate evaluation, the
  /// eliminated implicit step otherwise (numerics.md, "Eliminating the rest lengths").
  double *rest_a = nullptr, *rest_b = nullptr;
  const double* stiffness = nullptr;  ///< quadratic: k_l/l0(0)^2; relative: k_l
  double* gradient = nullptr;           ///< dU/dr, (x, y) per slot, which contacts add to at once
  double *gx = nullptr, *gy = nullptr;  ///< room to work in
  double* area = nullptr;               ///< per cell
};

/// Rates of the rest lengths, without padding, from the first vertex of the shell's first cell on; material per cell.
struct RestLengthFlow {
  const double *inverse_tau = nullptr, *memory = nullptr, *reference = nullptr;
  double* rate = nullptr;  ///< null: not wanted
};

/// Room for what a few cells' segments are, instead of the shell's arrays, which a large tissue would write to memory in vain.
struct SegmentRoom {
  static constexpr int arrays = 6, cells = 4;
  double* data = nullptr;  ///< null: into the shell's arrays
  std::size_t stride = 0;  ///< from one array to the next: at least 8 more than the slots of `cells` cells
};

/// What a gradient is evaluated at, without padding, from the first vertex of the shell's first cell on.
struct ShellInput {
  const double *x = nullptr, *y = nullptr;
  const double* rest_length = nullptr;  ///< null: rest_a + rest_b l as they are in the shell
  RestLengthFlow flow{};
  SegmentRoom room{};
};

/// Rest lengths rest_a + rest_b l at (x, y), without padding, from the first vertex of the shell's first cell on.
struct RestLengthLine {
  const double *x = nullptr, *y = nullptr;
  double* rest_length = nullptr;
};

/// Second derivatives of the shell at one point (see shell_linearise), at the slots of the vertices; nx, ny also at the slot
/// before and the one after.
struct ShellHessian {
  double *sxx = nullptr, *sxy = nullptr, *syy = nullptr;  ///< d2U/de2 of one segment
  double *nx = nullptr, *ny = nullptr;                    ///< d(phi)/de of one segment
  double *ax = nullptr, *ay = nullptr;                    ///< da/dr of one vertex
  double *pressure = nullptr, *area_curvature = nullptr;  ///< per cell: dU/da, d2U/da2
  double *vx = nullptr, *vy = nullptr, *ox = nullptr, *oy = nullptr;  ///< padded direction and product
};

/// Scalars of the contact law and of self-contact.
struct ContactScalars {
  double cutoff2 = 0, inner2 = 0;  ///< squares of s(1 + l2) and s(1 + l1)
  // u'(d)/d = inner_a/d + inner_b inside s(1 + l1), outer_a/d + outer_b beyond; u'' = inner_b, outer_b.
  double inner_a = 0, inner_b = 0, outer_a = 0, outer_b = 0;
  double self2 = 0;  ///< s^2
};

/// Segments of one window at most; with their last end point they are the four points that a lane looks at.
constexpr int window_segments = 3;
constexpr int window_bands = 5;
constexpr int window_terms = 2 * window_segments + 1;  ///< of its segments and points
/// Slots after a cell's vertices that the contact gradient adds to, if only zero to the last.
constexpr int contact_halo = window_segments + 1;

/// Vertex p against `segments` <= window_segments consecutive segments that start at slot q of another cell; `band` as in
/// contact_list.hpp. What lists are made of.
struct Window {
  int p, q;
  std::int16_t segments, band;
};

/// Windows side by side: what the contact kernels work on.
struct WindowGroup {
  static constexpr int windows = 64;
  struct Slots {
    int p, q;
  } slots[windows];
  std::uint64_t segments[window_segments];  ///< bit k of number j: window k has more than j segments
};

struct SelfPair {
  int i, j;
};

/// Boxes around eight consecutive segments each, widened by the reach. Eight more than there are can be read.
struct SegmentBoxes {
  double *x0 = nullptr, *y0 = nullptr, *x1 = nullptr, *y1 = nullptr;
};

/// Those near a cell, by neighbour and segment.
struct NearBoxes {
  struct Of {
    int cell, segment;      ///< number of the neighbour; first of the segments
    int first_slot, count;  ///< of the neighbour
    bool follows;           ///< the segments follow those of the box before
  };
  SegmentBoxes boxes;
  Of* of = nullptr;
  int count = 0;
};

/// A vertex in boxes of one neighbour: the first of them, and the place of its bits and distances.
struct NearGroup {
  int slot, box, place;
};

/// Consecutive segments near a vertex, and what cutting them into windows needs.
struct NearRun {
  int slot, q;                  ///< of the vertex and the first segment
  int at, length;               ///< distance2[at] belongs to the first segment
  int before_end, count, cell;  ///< segments of the neighbour from the first one on and in all; its number
  int nearest;                  ///< segment of the run
  unsigned nearer;              ///< how near its windows are (near_windows.inl)
  int windows;                  ///< that it is cut into
};

/// What near_windows looks for, and room to work in. A pair is a vertex and a box.
struct NearQuery {
  static constexpr int vertices = 32;  ///< at most at once
  Shell shell;
  NearBoxes near;
  double reach2 = 0;                                  ///< of the list, squared
  double edge2[window_bands - 1]{};                   ///< squared distances at which bands 1, 2, ... begin
  std::uint64_t *rows = nullptr, *columns = nullptr;  ///< near.count / 8, rounded up
  int* found = nullptr;                               ///< near.count + 1
  NearGroup* groups = nullptr;                        ///< pairs + 1
  unsigned char* bits = nullptr;                      ///< 2 pairs + 9
  int *segments = nullptr, *numbers = nullptr;        ///< 2 pairs + 1; segments of a cell
  double* distance2 = nullptr;                        ///< 24 pairs + 16
  NearRun* runs = nullptr;                            ///< 4 pairs + 1
};

/// One repulsive term of the contact energy, linearised: v.H v = (n.(w v))^2 with w = (1, -(1-t), -t) on (p, q, q + 1) and n
/// the normal times the square root of u''. What else the second derivative has (attraction, the turning of the normal, terms
/// that are subtracted) is left out: the sum is never negative.
struct ContactFactor {
  double nx, ny, t;
  int p, q;
};

/// Symmetric cyclic block-pentadiagonal matrices of 2 x 2 blocks, `lanes` of them side by side (1 or 8): element
/// (row, component, lane) is at [(row * 4 + component) * lanes + lane]. rows >= 3. The last two rows are the border,
/// which holds their couplings to rows 0 .. rows-3; lower1[rows-1] couples the two; lower1[0], lower2[0], lower2[1] are zero.
struct CyclicBatch {
  int rows = 0;
  double floor = 0.05;  ///< a pivot eigenvalue below it is lifted; the matrices are I + (something mostly positive)
  double *diagonal = nullptr, *lower1 = nullptr, *lower2 = nullptr, *border = nullptr;  ///< border: 2 * rows blocks
};

/// What the matrices of eight cells are made of, in lane order: element (row, lane) is at [row * 8 + lane], and the row
/// before a cell's first repeats its last vertex (so there is a row -1). As in ShellHessian unless noted.
struct CellRows {
  double *sxx = nullptr, *sxy = nullptr, *syy = nullptr, *nx = nullptr, *ny = nullptr;
  double *diagonal_xx = nullptr, *diagonal_xy = nullptr, *diagonal_yy = nullptr;  ///< d2U/dr2 of everything else
  double *lead = nullptr;  ///< per lane: identity rows before the cell's first, all rows in a lane without a cell
  double *pressure = nullptr, *bending_stiffness = nullptr;  ///< per lane
};

/// Sixteen factored cells of the same number of rows, one per lane, in single precision: element (row, component, lane) of the
/// blocks is at [(row * 4 + component) * 16 + lane], of the area's at [(row * 2 + component) * 16 + lane].
struct CellFactors {
  static constexpr int cells = 16;
  int rows = 0;
  float *diagonal = nullptr, *lower1 = nullptr, *lower2 = nullptr, *border = nullptr;  ///< as in CyclicBatch, factored
  float *area_gradient = nullptr, *area_solution = nullptr;  ///< g = da/dr and M^-1 g
  float* gain = nullptr;                                     ///< of the area's rank-one term (Sherman-Morrison), per lane
};

/// Where the cells of CellFactors lie in vectors of positions.
struct CellLanes {
  int cells = 0;                       ///< in use; the others repeat the first
  int first[CellFactors::cells] = {};  ///< vertex of each cell
  int lead[CellFactors::cells] = {};   ///< identity rows before it
  int common = 0;                      ///< largest lead
};

struct Table {
  const char* name;
  /// Fills the slots; segments and angles (which go to in.room if there is one), dU/dr of the shell and, where wanted, the rates of
  /// the rest lengths ([P] Eq. 5 and 10). False if an area, a length or a rest length is not positive.
  bool (*shell_gradient)(const Shell&, const ShellInput& in);
  void (*shell_segments)(const Shell&);  ///< segments and angles at the positions in the slots
  void (*shell_linearise)(const Shell&, const ShellHessian&);
  /// (ox, oy) = H_shell (vx, vy), overwritten including the halo. vx, vy must be padded. Overwrites gx, gy.
  void (*shell_product)(const Shell&, const ShellHessian&);
  /// What contacts added to repeated slots goes to the vertices, then all without padding to `values`.
  void (*fold_cells)(const Shell&, double* padded, double* values);
  void (*fold_gradient)(const Shell&, double* gx, double* gy);  ///< the same for dU/dr
  void (*rest_lengths)(const Shell&, const RestLengthLine&);
  void (*contact_gradient)(const Shell&, const ContactScalars&, const WindowGroup*, std::size_t windows, const SelfPair*, std::size_t);
  /// Appends repulsive terms; returns their number. `factors` must have room for window_terms per window and 1 per pair.
  std::size_t (*contact_linearise)(const Shell&, const ContactScalars&, const WindowGroup*, std::size_t windows, const SelfPair*,
                                   std::size_t, ContactFactor* factors);
  void (*contact_product)(const ContactFactor*, std::size_t, const double* vx, const double* vy, double* ox, double* oy);
  /// blocks: (xx, xy, yy, unused) per slot; adds the blocks on the diagonal.
  void (*contact_diagonal)(const ContactFactor*, std::size_t, double* blocks);
  /// Overwrites the batch by I + gamma H of one cell per lane, without the corners that close the ring.
  void (*cell_rows8)(const CellRows&, double gamma, const CyclicBatch&);
  /// Boxes of a cell's segments, widened by `margin`, from number `first` on; box: the whole cell's x0, y0, x1, y1, not widened.
  void (*segment_boxes)(const Shell&, int cell, double margin, const SegmentBoxes&, int first, double* box);
  /// Appends to the near boxes, of a cell's `box`, those of cell `other` (from number `first` on); `number` is the neighbour's.
  void (*near_boxes)(const Shell&, const double* box, const SegmentBoxes&, int first, int other, int number, NearBoxes&);
  /// Windows of `vertices` vertices from `slot` on, by vertex and cell (room: 8 pairs + 3), and their runs; returns how many runs.
  int (*near_windows)(const NearQuery&, int slot, int vertices, Window*);
  /// Of a cell's vertices first .. first + 7, `first` a multiple of eight, and later vertices that are not next to them: byte i of
  /// word k has a bit for vertex first + i and each of 8 k .. 8 k + 7 that is within reach of it. False if there is none.
  bool (*near_pairs)(const Shell&, int cell, int first, const SegmentBoxes&, int first_box, double reach2, std::uint64_t* words);
  /// Rounds eight factored cells into lanes 8 half .. 8 half + 7.
  void (*narrow_cells)(const CyclicBatch&, const double* area_gradient, const double* area_solution, int half, const CellFactors&);
  /// z = P^-1 r on the cells' points; y: from a point's x to its y; rhs: room for 32 floats per row, finite.
  void (*apply_cells)(const CellFactors&, const CellLanes&, const double* r, double* z, std::size_t y, float* rhs);
  void (*cyclic_factor1)(const CyclicBatch&);
  void (*cyclic_factor8)(const CyclicBatch&);
  /// rhs: (row, x or y, lane); overwritten by the solution.
  void (*cyclic_solve1)(const CyclicBatch&, double* rhs);
  void (*cyclic_solve8)(const CyclicBatch&, double* rhs);
  // Vectors of any length.
  double (*weighted_square_sum)(std::size_t n, const double* x, const double* w);  ///< sum (x w)^2
  double (*dot)(std::size_t n, const double* x, const double* y);
  double (*subtract_and_dot)(std::size_t n, const double* x, const double* y, const double* p, double* z);  ///< z = x - y; p.z
  double (*add_and_largest)(std::size_t n, const double* x, const double* y, double* z);  ///< z = x + y; largest |y|
  /// y0 += a x0, y1 += a x1
  void (*add_scaled_twice)(std::size_t n, double a, const double* x0, double* y0, const double* x1, double* y1);
  void (*linear_sum)(std::size_t n, double a, const double* x, double b, const double* y, double* z);
  void (*linear_combination)(std::size_t n, int count, const double* c, const double* const* x, double* z);
  void (*scale_add_multi)(std::size_t n, int count, const double* a, const double* x, const double* const* y, double* const* z);
  double (*largest_move2)(std::size_t n, const double* x, const double* y, const double* x0, const double* y0);  ///< squared
  bool (*finite)(std::size_t n, const double* x);  ///< all below 1e300
  /// f <- (q - psi) + gamma f; returns what finite would say of f before.
  bool (*implicit_residual)(std::size_t n, const double* q, const double* psi, double gamma, double* f);
  bool (*negate)(std::size_t n, double* x);        ///< in place; returns what finite would
};

extern const Table baseline;
extern const Table avx2;
extern const Table avx512;

/// The fastest table this processor can run.
const Table& best();

}  // namespace suture::kernels

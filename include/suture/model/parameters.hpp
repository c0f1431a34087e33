// Every number a user can set, in model units: length sqrt(a0), energy epsilon, time b a0/epsilon.
// One plain struct per configuration section; io/config.cpp holds the table that parses, validates and documents them.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Elastic law of a spring of length l and rest length l0 (Ton et al. 2023, Eq. 1).
enum class SpringLaw {
  relative,   ///< k/2 (l/l0 - 1)^2, strain relative to the CURRENT rest length (published simulations)
  quadratic,  ///< k/2 ((l - l0)/l0(0))^2, constant spring constant (printed equation)
};

/// Force law of a tether between a purse-string vertex and its cell vertex (Ton et al. 2023, Eq. 6).
enum class TetherLaw {
  saturating_force,   ///< |f| = k_p min(l, l_y/2) until yield at l_y
  saturating_energy,  ///< f = k_p l for l < l_y/2, zero beyond, yield at l_y (printed equation)
  published,          ///< each component clipped at +l_y/2 only; not rotation invariant; validation only
  ramp,               ///< f = k_p l up to l_y/2, then linearly back to zero at l_y
};

/// What a captured vertex does to the chain spring it splits.
enum class CaptureLaw {
  split,         ///< the split spring's rest length is halved; the tension rises with the detour over the new vertex
  tension_kept,  ///< both halves share the extension of the split spring: its tension, whatever the detour
  tension_free,  ///< both halves start without tension
  slip,          ///< published slip: the spring AFTER the new vertex's successor is halved instead
};

/// Which cell vertices are captured and where they join the ring.
enum class CaptureSearch {
  boundary,   ///< the exposed vertices of the wound's outline, in its order
  published,  ///< vertices near a flood fill, beside the nearest ring vertices (published simulations)
};

/// Rest length of the spring that closes the gap of consecutive tethers that yield together.
enum class GapLaw {
  span,   ///< the distance across the whole gap
  first,  ///< the distance to the vertex behind the first that yields, whether it yields too or not (older published program)
};

/// When discrete events of the purse string are processed.
enum class EventHandling {
  automatic,  ///< located, on the event grid while they storm (storm_rate)
  located,    ///< by root finding
  grid,       ///< at multiples of event_interval
  each_step,  ///< after every step of the integrator (published simulations); captures of CaptureSearch::boundary on the grid
};

/// Which cells count as adjacent to the wound when shapes are averaged.
enum class Adjacency {
  outline,  ///< with a vertex within sqrt(a0/pi) of the wound's outline (printed)
  string,   ///< with the centre within sqrt(4 a0/pi) of a purse-string vertex (published scripts)
};

/// Time integrators (suture/integrate/integrator.hpp).
enum class Method { cvode, rkc2, automatic, arkode, adams, euler, verlet, rk4 };

/// What the Newton steps of method cvode are preconditioned with (numerics.md).
enum class LinearSolver { structured, sparse_direct };

/// What a run does.
enum class Protocol {
  wound_closure,  ///< pack, anneal, ablate, relax, close (model.md section 6)
  compression,    ///< one cell between two plates, then released (Fig. 2c)
  dipole,         ///< one cell pulled by an extensile force dipole (Fig. S5)
};

/// Last stage of the wound-closure protocol to be run.
enum class Stage { packing, anneal, ablation, closure };

struct TissueParameters {
  std::uint64_t seed = 1;
  int cells = 50;
  int vertices = 30;             ///< per cell
  double shape_parameter = 1.2;  ///< rest shape A = p^2/(4 pi a)
  bool operator==(const TissueParameters&) const = default;
};

/// A group of cells that differs from the default; unset fields inherit from [tissue], [area], ....
struct CellType {
  std::string name;
  int cells = 0;
  std::optional<int> vertices;
  std::optional<double> rest_area, shape_parameter, area_stiffness, membrane_stiffness, bending_stiffness, tau, memory;
  bool operator==(const CellType&) const = default;
};

struct AreaParameters {
  double stiffness = 16.0;  ///< k_a
  bool operator==(const AreaParameters&) const = default;
};

struct MembraneParameters {
  SpringLaw law = SpringLaw::quadratic;
  double stiffness = 1.0;  ///< k_l
  bool operator==(const MembraneParameters&) const = default;
};

struct BendingParameters {
  double stiffness = 0.01;  ///< k_b
  bool operator==(const BendingParameters&) const = default;
};

struct ContactParameters {
  double energy = 0.5;             ///< e
  std::optional<double> distance;  ///< s; unset: the mean initial rest length l0(0)
  double adhesion = 0.1;           ///< l1, in units of s; 0 = pure repulsion
  double range = 0.3;              ///< l2, in units of s
  bool self_contact = true;
  bool operator==(const ContactParameters&) const = default;
};

struct PlasticityParameters {
  double tau = 9.6;     ///< relaxation time of rest lengths; infinity = elastic
  double memory = 0.0;  ///< xi, shape-memory ratio
  bool operator==(const PlasticityParameters&) const = default;
};

struct PurseStringParameters {
  bool enabled = true;
  double stiffness = 1.0;              ///< k_ps
  SpringLaw law = SpringLaw::quadratic;
  double constriction_rate = 1.0;      ///< omega
  double minimum_rest_length = 0.0;    ///< lambda_min, in units of s
  double tether_stiffness = 4.0;       ///< k_p
  TetherLaw tether_law = TetherLaw::saturating_energy;
  double yield_length = 2.0;           ///< l_y, in units of s
  CaptureLaw capture_law = CaptureLaw::tension_kept;
  bool capture = true;
  CaptureSearch capture_search = CaptureSearch::boundary;
  int search_steps = 500;              ///< integrator steps between flood fills of CaptureSearch::published
  int capture_steps = 500;             ///< integrator steps between offers of the vertices it found to the string
  GapLaw gap_law = GapLaw::span;
  int crevice_depth = 1;               ///< vertices the string follows each cell into a crevice, beyond the exposed ones
  EventHandling event_handling = EventHandling::automatic;
  double event_interval = 0.05;        ///< of the event grid; located: from a yield to when the vertex may be captured again
  double storm_rate = 60.0;            ///< tether events per unit of time beyond which EventHandling::automatic turns to the grid
  bool operator==(const PurseStringParameters&) const = default;
};

struct PackingParameters {
  double initial_fraction = 0.78;
  double final_fraction = 0.985;
  double increment = 0.005;
  double adhesion = 0.0;           ///< l1 while compressing
  double area_stiffness = 16.0;    ///< k_a while compressing
  double bending_stiffness = 0.01; ///< k_b while compressing
  double shape_noise = 0.01;       ///< random radial displacement of the first polygons' corners, relative
  double wall_energy = 1.0;        ///< e_cb
  double wall_range = 0.5;         ///< sigma, in units of s
  double step_tolerance = 2e-3;    ///< largest force component before the next compression step
  double force_tolerance = 1e-6;   ///< largest force component of the finished packing
  int maximum_iterations = 200000; ///< FIRE iterations per minimisation
  int attempts = 3;                ///< packings tried, each from its own random numbers, until one is accepted
  bool operator==(const PackingParameters&) const = default;
};

struct AnnealParameters {
  double temperature = 0.01;
  double duration = 1.0;         ///< constant-energy motion
  double time_step = 0.0025;     ///< velocity Verlet
  double relaxation_time = 100.0;///< overdamped, after the constant-energy motion
  double tolerance = 1e-3;       ///< of the overdamped motions before closure (always cvode), in units of l0(0)
  bool operator==(const AnnealParameters&) const = default;
};

struct WoundParameters {
  int cells = 5;                  ///< ablated, nearest the tissue centre
  double relaxation_time = 100.0; ///< overdamped, elastic, without purse string
  double minimum_area = 5.0;      ///< a packing whose wound is smaller is refused
  double maximum_area = 6.5;
  double maximum_hole = 0.05;     ///< largest hole of an accepted packing
  bool operator==(const WoundParameters&) const = default;
};

struct CompressionParameters {
  double gap = 0.7;         ///< distance between the plates while compressed, in units of the cell's diameter
  double closing_time = 1.0;///< in which the plates close at constant speed; part of T
  double duration = 100.0;  ///< T
  double recovery = 200.0;  ///< time observed after release
  double plate_energy = 1.0;///< plate stiffness, as the confinement law
  bool operator==(const CompressionParameters&) const = default;
};

struct DipoleParameters {
  double force = 0.01;      ///< on each vertex, away from the centre of mass
  double duration = 500.0;  ///< T
  bool operator==(const DipoleParameters&) const = default;
};

struct RunParameters {
  Protocol protocol = Protocol::wound_closure;
  Stage last_stage = Stage::closure;
  double end_time = 2000.0;     ///< after creation of the purse string
  double closed_area = 0.01;    ///< the wound counts as closed below this area
  std::string start_from;       ///< run.h5 of an earlier run; its last complete stage is continued
  bool operator==(const RunParameters&) const = default;
};

struct IntegratorParameters {
  Method method = Method::cvode;
  double tolerance = 1e-3;           ///< on positions, in units of l0(0)
  double rest_length_tolerance = 1e-3; ///< on rest lengths, in units of l0(0)
  double local_error_fraction = 0.5; ///< CVODE's BDF: estimated error of a step at most this part of the tolerances
  int maximum_order = 3;             ///< forces have kinks: higher orders amplify what the solver leaves
  LinearSolver linear_solver = LinearSolver::structured;
  bool keep_history = true;          ///< carry the multistep history over events
  double maximum_step = std::numeric_limits<double>::infinity();
  std::optional<double> time_step;   ///< fixed-step methods; unset: 0.01 l0/sqrt(k_a)
  double vertex_mass = 1.0;          ///< of method verlet; the overdamped motion has none
  double switch_stages = 8.0;        ///< method auto: rates per step of RKC2 from which CVODE takes over
  double skin = 0.4;                 ///< Verlet-list skin, in units of l0(0)
  int threads = 1;
  bool operator==(const IntegratorParameters&) const = default;
};

struct OutputParameters {
  double interval = 0.5;        ///< of wound.csv samples
  double frame_interval = 5.0;  ///< of stored configurations
  Adjacency adjacency = Adjacency::outline; ///< of the mean shape and the healed shape
  int pictures = 6;             ///< frames drawn along the run
  bool operator==(const OutputParameters&) const = default;
};

struct CheckpointParameters {
  double interval = std::numeric_limits<double>::infinity();  ///< model time between configured checkpoints
  double wall_interval = 600.0;  ///< seconds between the others
  bool reproducible = false;     ///< only configured checkpoints, so that a resumed run has the bits of an uninterrupted one
  double sync_interval = 5.0;    ///< seconds between flushes of the journal to the disk
  bool operator==(const CheckpointParameters&) const = default;
};

struct UnitParameters {
  double rest_area_um2 = 25.0;             ///< a0
  double unsticking_force_nN = 1.0;        ///< f_adh
  double constriction_rate_um_per_s = 0.3; ///< omega
  bool operator==(const UnitParameters&) const = default;
};

struct Config {
  std::string preset = "printed";
  TissueParameters tissue;
  std::vector<CellType> cell_types;
  AreaParameters area;
  MembraneParameters membrane;
  BendingParameters bending;
  ContactParameters contact;
  PlasticityParameters plasticity;
  PurseStringParameters purse_string;
  PackingParameters packing;
  AnnealParameters anneal;
  WoundParameters wound;
  CompressionParameters compression;
  DipoleParameters dipole;
  RunParameters run;
  IntegratorParameters integrator;
  OutputParameters output;
  CheckpointParameters checkpoint;
  UnitParameters units;
  bool operator==(const Config&) const = default;
};

}  // namespace suture

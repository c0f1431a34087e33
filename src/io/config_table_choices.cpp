// The allowed words of every key that takes one.
#include <array>

#include "config_table.hpp"

namespace suture {

namespace {

template <class Enumeration>
constexpr Choice choice(std::string_view name, Enumeration value, std::string_view doc = {}) {
  return {name, static_cast<int>(value), doc};
}

constexpr std::array spring_laws{
    choice("relative", SpringLaw::relative, "k/2 (l/l0 - 1)^2, strain relative to the current rest length"),
    choice("quadratic", SpringLaw::quadratic, "k/2 ((l - l0)/l0(0))^2, constant spring constant (printed equation)"),
};
constexpr std::array tether_laws{
    choice("saturating_force", TetherLaw::saturating_force, "|f| = k_p min(l, l_y/2) until the tether yields at l_y"),
    choice("saturating_energy", TetherLaw::saturating_energy, "f = k_p l for l < l_y/2, zero beyond (printed Eq. 6)"),
    choice("published", TetherLaw::published,
           "each component clipped at +l_y/2 only; depends on direction, for validation only"),
    choice("ramp", TetherLaw::ramp, "f = k_p l up to l_y/2, then linearly back to zero at l_y; continuous"),
};
constexpr std::array capture_laws{
    choice("tension_kept", CaptureLaw::tension_kept, "both halves get the rest length with which they carry the tension of the split spring"),
    choice("split", CaptureLaw::split,
           "the split spring's rest length is halved; a vertex beside the spring stretches the halves and raises their tension"),
    choice("tension_free", CaptureLaw::tension_free, "both halves start without tension"),
    choice("slip", CaptureLaw::slip, "halves the wrong spring, as the published simulations did; for their fixed steps: methods with error control crawl or fail at it"),
};
constexpr std::array capture_searches{
    choice("boundary", CaptureSearch::boundary, "the exposed vertices of the wound's outline, in its order"),
    choice("published", CaptureSearch::published,
           "vertices near a flood fill of the wound, beside the nearest ring vertices; validation only"),
};
constexpr std::array gap_laws{
    choice("span", GapLaw::span, "the distance across the whole gap: no tension"),
    choice("first", GapLaw::first,
           "the distance across the first of them only, as an older state of the published program did; validation only"),
};
constexpr std::array event_handlings{
    choice("auto", EventHandling::automatic, "located, but on the event grid while they storm (storm_rate)"),
    choice("automatic", EventHandling::automatic),
    choice("located", EventHandling::located, "each breaking, change of mode and capture is located in time"),
    choice("grid", EventHandling::grid, "events are processed at multiples of event_interval"),
    choice("each_step", EventHandling::each_step, "after every integrator step, as the published simulations did; captures of capture_search \"boundary\" on the event grid"),
};
constexpr std::array adjacencies{
    choice("outline", Adjacency::outline, "cells with a vertex within sqrt(a0/pi) of the wound's outline (printed)"),
    choice("string", Adjacency::string,
           "cells with their centre within sqrt(4 a0/pi) of a purse-string vertex (published scripts)"),
};
constexpr std::array methods{
    choice("cvode", Method::cvode, "implicit BDF of variable order with a minimising Newton solver"),
    choice("rkc2", Method::rkc2, "stabilised explicit Runge-Kutta-Chebyshev of order 2, adaptive"),
    choice("rkc", Method::rkc2),
    choice("auto", Method::automatic, "rkc2, and cvode where the steps of rkc2 take many stages"),
    choice("automatic", Method::automatic),
    choice("arkode", Method::arkode, "explicit Runge-Kutta of order 3 (Bogacki-Shampine), adaptive"),
    choice("adams", Method::adams, "Adams formulas of variable order with fixed-point iteration, adaptive"),
    choice("euler", Method::euler, "explicit Euler with a fixed step (published simulations)"),
    choice("verlet", Method::verlet, "modified velocity Verlet with a fixed step; gives vertices a mass"),
    choice("rk4", Method::rk4, "classical Runge-Kutta of order 4 with a fixed step"),
};
constexpr std::array linear_solvers{
    choice("structured", LinearSolver::structured, "conjugate gradients, preconditioned cell by cell"),
    choice("sparse_direct", LinearSolver::sparse_direct,
           "the whole matrix assembled and factored at every Newton iteration; slow, for verification"),
};
constexpr std::array protocols{
    choice("wound_closure", Protocol::wound_closure, "pack, anneal, ablate, relax and close a wound"),
    choice("compression", Protocol::compression, "one cell between two plates, then released (Fig. 2c)"),
    choice("dipole", Protocol::dipole, "one cell pulled by an extensile force dipole (Fig. S5)"),
};
constexpr std::array stages{
    choice("packing", Stage::packing, "stop after the cells are compressed to the final packing fraction"),
    choice("anneal", Stage::anneal, "stop after adhesion, thermal motion and relaxation"),
    choice("ablation", Stage::ablation, "stop after the cells are removed and the wound has relaxed"),
    choice("closure", Stage::closure, "run until the wound is closed or end_time"),
};

}  // namespace

template <>
std::span<const Choice> choices_of<SpringLaw>() {
  return spring_laws;
}
template <>
std::span<const Choice> choices_of<TetherLaw>() {
  return tether_laws;
}
template <>
std::span<const Choice> choices_of<CaptureLaw>() {
  return capture_laws;
}
template <>
std::span<const Choice> choices_of<CaptureSearch>() {
  return capture_searches;
}
template <>
std::span<const Choice> choices_of<GapLaw>() {
  return gap_laws;
}
template <>
std::span<const Choice> choices_of<EventHandling>() {
  return event_handlings;
}
template <>
std::span<const Choice> choices_of<Adjacency>() {
  return adjacencies;
}
template <>
std::span<const Choice> choices_of<Method>() {
  return methods;
}
template <>
std::span<const Choice> choices_of<LinearSolver>() {
  return linear_solvers;
}
template <>
std::span<const Choice> choices_of<Protocol>() {
  return protocols;
}
template <>
std::span<const Choice> choices_of<Stage>() {
  return stages;
}

}  // namespace suture

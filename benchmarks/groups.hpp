// The groups of measurements; main.cpp runs those that are asked for.
#pragma once

#include "problems.hpp"
#include "report.hpp"

namespace suture::benchmark {

/// Rate, linearisation, product, preconditioner and list rebuild, per vertex; the ladders of n_v and N.
void measure_kernels(const Settings& settings, Report& report);
/// One rate per vertex against N and against the age of the contact list; two threads against one.
void measure_rates(const Settings& settings, Report& report);
/// Packing; closures of embryo and wing disc by several methods.
void measure_packing(const Settings& settings, Report& report);
void measure_closures(const Settings& settings, Report& report, const Packed& wounded);
/// Smooth runs (ring on, no events): ladders of k_a and tau with counts.
void measure_ladders(const Settings& settings, Report& report, const Packed& wounded);
/// Cases B, C and D of the design: methods against a reference.
void measure_cases(const Settings& settings, Report& report, const Packed& wounded);
/// Closures of honeycombs of 10^3, 10^4 and (long) 10^5 cells, by one and two threads: time, memory, counts.
void measure_large_tissues(const Settings& settings, Report& report);
/// What an error of 1e-3 l0 costs by Euler, rkc2 and cvode: nodes of k_a and tau, n_v, stiff rings.
void measure_rivals(const Settings& settings, Report& report);
/// The same in closures with all events: nodes, embryos.
void measure_rivals_with_events(const Settings& settings, Report& report);
/// Actual over requested error on the grid of k_a and tau.
void measure_tolerance_grid(const Settings& settings, Report& report);

}  // namespace suture::benchmark

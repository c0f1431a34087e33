// Fig. 1: experimental wound area against time with double-exponential fits, and the shape of the cells beside the wound with moving
// averages. Data: Tetley et al. 2019, read off the figure of Ton et al. 2023 (data/published/README.md).
//   fig1 OUTPUT_FOLDER PUBLISHED_FOLDER [WINDOW]      WINDOW: of the moving average in min (default 30, as drawn in Fig. 1b)
#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "../csv.hpp"

using namespace suture;
using namespace suture::figures;

namespace {

struct Data {
  std::vector<double> t, value;
};

Data select(const std::vector<CsvRow>& rows, const std::string& tissue, const std::string& column) {
  Data data;
  for (const CsvRow& row : rows)
    if (row.at("tissue") == tissue) data.t.push_back(number(row, "t_min")), data.value.push_back(number(row, column));
  return data;
}

using Parameters = std::array<double, 4>;  // a1, b1, a2, b2 of a1 exp(-b1 t) + a2 exp(-b2 t)

int residuals(const gsl_vector* p, void* pointer, gsl_vector* out) {
  const auto& data = *static_cast<const Data*>(pointer);
  const double a1 = gsl_vector_get(p, 0), b1 = gsl_vector_get(p, 1), a2 = gsl_vector_get(p, 2), b2 = gsl_vector_get(p, 3);
  for (std::size_t i = 0; i < data.t.size(); ++i)
    gsl_vector_set(out, i, a1 * std::exp(-b1 * data.t[i]) + a2 * std::exp(-b2 * data.t[i]) - data.value[i]);
  return GSL_SUCCESS;
}

int jacobian(const gsl_vector* p, void* pointer, gsl_matrix* out) {
  const auto& data = *static_cast<const Data*>(pointer);
  for (std::size_t i = 0; i < data.t.size(); ++i)
    for (const std::size_t k : {0, 2}) {
      const double e = std::exp(-gsl_vector_get(p, k + 1) * data.t[i]);
      gsl_matrix_set(out, i, k, e);
      gsl_matrix_set(out, i, k + 1, -gsl_vector_get(p, k) * data.t[i] * e);
    }
  return GSL_SUCCESS;
}

struct Fit {
  Parameters value, error;
  double rms = 0.0;
};

/// Least squares over all experiments together, every point with the same weight; standard errors from the covariance at the
/// minimum, scaled with the residual variance. Throws NumericalError when GSL does not converge.
Fit fit(Data& data, const Parameters& start) {
  constexpr std::size_t count = 4;
  gsl_multifit_nlinear_fdf problem{};
  problem.f = residuals, problem.df = jacobian, problem.n = data.t.size(), problem.p = count, problem.params = &data;
  gsl_multifit_nlinear_parameters options = gsl_multifit_nlinear_default_parameters();
  options.trs = gsl_multifit_nlinear_trs_lmaccel;  // the two exponentials are nearly collinear; plain steps crawl
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &options, problem.n, count), gsl_multifit_nlinear_free);
  const gsl_vector_const_view first = gsl_vector_const_view_array(start.data(), count);
  gsl_multifit_nlinear_init(&first.vector, &problem, work.get());
  int info = 0;
  if (const int status = gsl_multifit_nlinear_driver(1000, 1e-12, 1e-12, 1e-12, nullptr, nullptr, &info, work.get()); status != GSL_SUCCESS)
    throw NumericalError(fmt::format("the fit does not converge: {}", gsl_strerror(status)));
  double squares = 0.0;
  gsl_blas_ddot(work->f, work->f, &squares);
  Parameters covariance_rows[count];
  gsl_matrix_view covariance = gsl_matrix_view_array(covariance_rows[0].data(), count, count);
  gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work.get()), 0.0, &covariance.matrix);
  Fit result;
  const double variance = squares / static_cast<double>(problem.n - count);
  for (std::size_t k = 0; k < count; ++k) {
    result.value[k] = gsl_vector_get(work->x, k);
    result.error[k] = std::sqrt(variance * covariance_rows[k][k]);
  }
  result.rms = std::sqrt(squares / static_cast<double>(problem.n));
  return result;
}

double evaluate(const Parameters& p, double t) { return p[0] * std::exp(-p[1] * t) + p[2] * std::exp(-p[3] * t); }

double moving_average(const Data& data, double t, double window) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < data.t.size(); ++i)
    if (std::abs(data.t[i] - t) < 0.5 * window) sum += data.value[i], ++count;
  return sum / count;  // never empty: t is one of the times
}

void fit_area(const std::vector<CsvRow>& rows, const std::string& tissue, const Parameters& printed,
              CsvFile& parameters, CsvFile& curves) {
  Data data = select(rows, tissue, "area_norm");
  const Fit best = fit(data, printed);
  const char* names[] = {"a1", "b1_per_min", "a2", "b2_per_min"};
  for (int k = 0; k < 4; ++k) parameters.row(tissue, names[k], best.value[k], best.error[k], printed[k]);
  double squares = 0.0;
  for (std::size_t i = 0; i < data.t.size(); ++i) squares += std::pow(evaluate(printed, data.t[i]) - data.value[i], 2);
  parameters.row(tissue, "rms_residual", best.rms, 0.0, std::sqrt(squares / static_cast<double>(data.t.size())));
  const double last = *std::max_element(data.t.begin(), data.t.end());
  for (int i = 0; i <= 200; ++i) {
    const double t = last * i / 200;
    curves.row(tissue, t, evaluate(best.value, t), evaluate(printed, t));
  }
}

}  // namespace

int main(int argc, char** argv) {
  gsl_set_error_handler_off();  // return codes are looked at
  return figure_main(argc, argv, [](const auto& out, const auto& published, const auto& more) {
    const double window = more.empty() ? 30.0 : std::stod(more.front());
    if (!(window > 0.0)) throw InputError(fmt::format("window: found {}, allowed a number of minutes > 0", window));
    const auto areas = read_csv(published / "fig1_wound_area.csv"), shapes = read_csv(published / "fig1_cell_shape.csv");
    CsvFile parameters(out / "fit.csv", "tissue,parameter,value,standard_error,printed");
    CsvFile curves(out / "fit_curve.csv", "tissue,t_min,fitted,printed");
    fit_area(areas, "embryo", {-2.7831, 0.2966, 3.6255, 0.1172}, parameters, curves);
    fit_area(areas, "wing_disc", {0.9420, 0.0690, 0.3425, 0.0107}, parameters, curves);
    CsvFile averages(out / "moving_average.csv", "tissue,window_min,t_min,shape");
    for (const std::string tissue : {"embryo", "wing_disc"}) {
      const Data data = select(shapes, tissue, "shape_A");
      const std::set<double> times(data.t.begin(), data.t.end());
      for (const double t : times) averages.row(tissue, window, t, moving_average(data, t, window));
    }
  });
}

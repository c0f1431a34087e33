#include "suture/physics/term.hpp"

namespace suture {

namespace {

/// Multiplies every block with v as it arrives.
class ProductSink final : public HessianSink {
 public:
  ProductSink(std::span<const double> vx, std::span<const double> vy, std::span<double> outx, std::span<double> outy)
      : vx_(vx), vy_(vy), outx_(outx), outy_(outy) {}

  void add_block(int i, int j, const Block& block) override {
    outx_[i] += block[0] * vx_[j] + block[1] * vy_[j];
    outy_[i] += block[2] * vx_[j] + block[3] * vy_[j];
    if (i == j) return;
    outx_[j] += block[0] * vx_[i] + block[2] * vy_[i];
    outy_[j] += block[1] * vx_[i] + block[3] * vy_[i];
  }

  void add_rank_one(int first, double coefficient, std::span<const double> gx, std::span<const double> gy) override {
    double projection = 0.0;
    for (std::size_t k = 0; k < gx.size(); ++k) projection += gx[k] * vx_[first + k] + gy[k] * vy_[first + k];
    for (std::size_t k = 0; k < gx.size(); ++k) {
      outx_[first + k] += coefficient * projection * gx[k];
      outy_[first + k] += coefficient * projection * gy[k];
    }
  }

 private:
  std::span<const double> vx_, vy_;
  std::span<double> outx_, outy_;
};

}  // namespace

void add_hessian_product(const EnergyTerm& term, double t, const StateView& state, std::span<const double> vx,
                         std::span<const double> vy, std::span<double> outx, std::span<double> outy) {
  ProductSink sink(vx, vy, outx, outy);
  term.add_hessian(t, state, sink);
}

}  // namespace suture

#include "dcm/operator_assembly.h"

namespace morula::dcm {
namespace {

constexpr float kAlmost = 0.99999f;   // of the stiffness is taken away: what is left stays positive in spite of rounding
constexpr double kLeastPivot = 1e-6;  // in units of the trace: below it a rotation has no stiffness that could be taken away

}  // namespace

template <int W>
void free_rotations(Assembly<W>& a) noexcept {
  using Real = Lane<float, W>;
  using Double = Lane<double, W>;
  float* const rotation = a.out.rotation.data();
  const auto y = [&](std::size_t node, std::size_t axis) { return load_vec3<float, W>(rotation, 3 * node + axis); };
  const auto to_double = [](const Real& r) { return Double::from(__builtin_convertvector(r.v, typename Double::Vector)); };
  Double s00(0.0), s10(0.0), s20(0.0), s11(0.0), s21(0.0), s22(0.0);  // S = Rᵀ K R: torques of the forces
  for (std::size_t i = 0; i < a.topology.node_count(); ++i) {
    const auto x = a.x(i);
    const auto about_x = cross(x, y(i, 0)), about_y = cross(x, y(i, 1)), about_z = cross(x, y(i, 2));
    s00 += to_double(about_x.x), s10 += to_double(about_x.y), s20 += to_double(about_x.z);
    s11 += to_double(about_y.y), s21 += to_double(about_y.z), s22 += to_double(about_z.z);
  }
  // S = G Gᵀ by Cholesky's method. A rotation without stiffness has a row of zeros in the inverse.
  const Double least = Double(kLeastPivot) * (s00 + s11 + s22);
  const auto inverse_root = [&](const Double& pivot) {
    const auto counts = (pivot > least) & (pivot > Double(0.0));
    return select(counts, Double(1.0) / sqrt(select(counts, pivot, Double(1.0))), Double(0.0));
  };
  const Double i0 = inverse_root(s00), g10 = s10 * i0, g20 = s20 * i0;
  const Double i1 = inverse_root(s11 - g10 * g10), g21 = (s21 - g20 * g10) * i1;
  const Double i2 = inverse_root(s22 - g20 * g20 - g21 * g21);
  const Real f0 = to_float<W>(i0), f1 = to_float<W>(i1), f2 = to_float<W>(i2);
  const Real h10 = to_float<W>(g10), h20 = to_float<W>(g20), h21 = to_float<W>(g21), almost(kAlmost);
  for (std::size_t i = 0; i < a.topology.node_count(); ++i) {
    const auto y0 = y(i, 0) * f0, y1 = (y(i, 1) - y0 * h10) * f1, y2 = (y(i, 2) - y0 * h20 - y1 * h21) * f2;
    store_vec3<float, W>(rotation, 3 * i, y0 * almost);
    store_vec3<float, W>(rotation, 3 * i + 1, y1 * almost);
    store_vec3<float, W>(rotation, 3 * i + 2, y2 * almost);
  }
}

template void free_rotations<1>(Assembly<1>&) noexcept;
template void free_rotations<4>(Assembly<4>&) noexcept;
template void free_rotations<8>(Assembly<8>&) noexcept;

}  // namespace morula::dcm

// Spheres: the contact of Johnson, Kendall and Roberts, and the packing of spheres (cbm.md).
#include <cmath>
#include <cstdio>
#include <numbers>

#include "cbm/laws/jkr.h"
#include "cbm/laws/sphere_caps.h"
#include "cbm/packing.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr const char* kClosedForm = "closed form";
constexpr const char* kIndependent = "computed independently";
constexpr const char* kJkr = "Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141";

cbm::PairLaw<double> reference_pair() { return cbm::make_pair_law(cbm::ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.1), 5.0, 5.0); }

void add_pairs(std::vector<ReferenceNumber>& out) {
  const auto relative = [](double value, double part) { return std::abs(value) * part; };
  out.push_back({"JKR", "reduced modulus of the reference pair [kPa]", 0.267857143, relative(0.267857143, 2e-9), kClosedForm,
                 [] { return reference_pair().modulus; }});
  out.push_back({"JKR", "pull-off force, R 5/5 um, W 0.1 nN/um [nN]", 1.178097, relative(1.178097, 1e-6), kJkr,
                 [] { return cbm::pull_off_force(reference_pair()); }});
  out.push_back({"JKR", "overlap without load [um]", 1.371402, relative(1.371402, 1e-6), kJkr,
                 [] { return cbm::zero_load_overlap(reference_pair()); }});
  out.push_back({"JKR", "slope of the force without load [nN/um]", 1.0308549, relative(1.0308549, 1e-7), kJkr,
                 [] { return cbm::jkr_slope(reference_pair(), cbm::zero_load_overlap(reference_pair())); }});
  struct Point {
    double overlap, radius, force;
  };
  for (const Point& p :
       {Point{-0.360562, 1.040042, -1.5}, Point{0.0, 1.259921, -4.0 / 3.0}, Point{2.0, 2.0, 8.0 / 3.0}, Point{6.550510, 3.0, 21.303062}}) {
    char at[48];
    std::snprintf(at, sizeof at, " at overlap %g (dimensionless)", p.overlap);
    out.push_back({"JKR", std::string("contact radius") + at, p.radius, 4e-6, kJkr, [p] {
                     const auto law = reference_pair();
                     return cbm::jkr_contact(law, p.overlap * law.length).contact_radius / law.radius;
                   }});
    out.push_back({"JKR", std::string("force") + at, p.force, 6e-6, kJkr, [p] {
                     const auto law = reference_pair();
                     return cbm::jkr_contact(law, p.overlap * law.length).force / law.force;
                   }});
  }
}

/// Pressure of face-centred cubic spheres (R 6, E 0.45, ν 0.4) with the packing of an ideal filled cell (K_V 2.5), 2√2 F/d² [kPa].
double packed_pressure(double s) {
  const auto curve = cbm::PackingCurve::through(cbm::ideal_filled_cell(kBulk, 0.45, 0.4).value()).value();
  const double d = 2.0 * kRadius * (1.0 - s);
  const auto hertz =
      cbm::hertz_contact(cbm::make_pair_law(cbm::ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.0), kRadius, kRadius), 2.0 * kRadius - d);
  const auto caps = cbm::sphere_caps(kRadius, kRadius, d);
  const double pressure = curve.at(12.0 * caps.volume_a / ball_volume(kRadius)).pressure;
  return 2.0 * std::numbers::sqrt2 * (hertz.force + pressure * (caps.slope_a + caps.slope_b)) / (d * d);
}

void add_packing(std::vector<ReferenceNumber>& out) {
  out.push_back({"cbm 3", "cap of a sphere of 6 um behind the plane it shares with one of 5 um at 9.5 um [um^3]", 8.1717292, 5.1e-8,
                 kIndependent, [] { return cbm::sphere_caps(6.0, 5.0, 9.5).volume_a; }});
  out.push_back({"cbm 3", "its change with the distance [um^2]", -10.4861986, 5.1e-8, kIndependent,
                 [] { return -cbm::sphere_caps(6.0, 5.0, 9.5).slope_a; }});
  out.push_back({"cbm 3", "packing at which an ideal filled cell presses, E 450 Pa, K_V 2.5 kPa", 0.0829053, 5.1e-8, kIndependent,
                 [] { return cbm::ideal_filled_cell(kBulk, 0.45, 0.4).value().front().packing; }});
  struct Point {
    double s, pressure;
  };
  for (const Point& p : {Point{0.05, 6.257e-3}, Point{0.115, 165.12e-3}, Point{0.12, 207.61e-3}, Point{0.20, 922.44e-3}}) {
    char what[96];
    std::snprintf(what, sizeof what, "pressure of cubic close packed filled cells at overlap %g of the diameter [kPa]", p.s);
    out.push_back({"cbm 3", what, p.pressure, 0.005 * p.pressure, "computed independently; 0.5 % for eight knots",
                   [p] { return packed_pressure(p.s); }});
  }
}

}  // namespace

void add_sphere_numbers(std::vector<ReferenceNumber>& out) {
  add_pairs(out);
  add_packing(out);
}

}  // namespace morula::scenarios

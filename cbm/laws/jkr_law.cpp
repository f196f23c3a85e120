#include <cmath>
#include <numbers>

#include "cbm/laws/jkr.h"
#include "cbm/pair_loop.h"
#include "cbm/sphere_keys.h"
#include "cbm/spheres.h"
#include "core/simd/transpose.h"

namespace morula::cbm {
namespace {

/// The law of a pair with the scales of its material; see cbm/laws/jkr.h.
template <class Real>
struct Jkr {
  Real modulus;        // E*
  Real adhesion;       // W
  Real length_factor;  // (π²W²/E*²)^(1/3)
  Real radius_factor;  // (πW/E*)^(1/3)

  Remembered<double> respond(double reduced_radius, double overlap, bool attached) const noexcept requires std::is_same_v<Real, double> {
    const PairLaw<double> law = make_pair_law({modulus, adhesion, length_factor, radius_factor}, reduced_radius);
    return {contact_response(law, overlap, attached), update_attached(overlap, attached, law)};
  }

  /// Of the two branches only those are computed that a pair of the block is on.
  Remembered<Real> respond(const Real& reduced_radius, const Real& overlap, MaskOf<Real> attached) const noexcept
      requires(!std::is_same_v<Real, double>) {
    constexpr int kWidth = Real::width;
    const auto adheres = adhesion > Real(0.0);
    attached = attached & adheres;
    PairLaw<Real> law;
    law.modulus = modulus, law.reduced_radius = reduced_radius;
    if (!any_lane<kWidth>(attached)) return {hertz_contact(law, overlap), (overlap >= Real(0.0)) & adheres};
    Real root;
    for (int lane = 0; lane < kWidth; ++lane) root.set(lane, cube_root_start(reduced_radius[lane]));
    root = cube_root_refined(reduced_radius, root);
    law.length = length_factor * root;
    law.inverse_length = select(adheres, Real(1.0) / law.length, Real(0.0));
    law.radius = radius_factor * (root * root);
    law.force = Real(std::numbers::pi) * adhesion * reduced_radius;
    ContactResponse<Real> out = jkr_contact(law, overlap);
    if (any_lane<kWidth>(~attached)) {
      const ContactResponse<Real> hertz = hertz_contact(law, overlap);
      out.force = select(attached, out.force, hertz.force);
      out.stiffness = select(attached, out.stiffness, hertz.stiffness);
      out.area = select(attached, out.area, hertz.area);
      out.energy = select(attached, out.energy, hertz.energy);
    }
    // as update_attached()
    return {out, (overlap >= select(attached, Real(kBreakOverlap) * law.length, Real(0.0))) & adheres};
  }
};

PairCoefficients couple(const SphereParameters& a, const SphereParameters* b, double adhesion) {
  // Of two types with laws of their own fit, the geometric mean; what spheres do on an obstacle no fit says.
  if (b != nullptr && (a.adhesion_factor != 1.0 || b->adhesion_factor != 1.0))
    adhesion *= std::sqrt(a.adhesion_factor * b->adhesion_factor);
  const ContactMaterial m = b != nullptr ? ContactMaterial::elastic(a.young, a.poisson, b->young, b->poisson, adhesion)
                                         : ContactMaterial::against_rigid(a.young, a.poisson, adhesion);
  return {m.modulus, m.adhesion, m.length_factor, m.radius_factor};
}

PairLaw<double> pair_law(const PairCoefficients& c, double reduced_radius) {
  return make_pair_law({c[0], c[1], c[2], c[3]}, reduced_radius);
}

/// 0.75 X, X = (π² W² R*/E*²)^(1/3)
double reach(const PairContact& contact, double reduced_radius) {
  const PairCoefficients& c = contact.coefficient;
  return 0.75 * std::cbrt(std::numbers::pi * std::numbers::pi * c[1] * c[1] * reduced_radius / (c[0] * c[0]));
}

std::vector<double> jumps(const PairContact& contact, double reduced_radius) {
  return {kBreakOverlap * pair_law(contact.coefficient, reduced_radius).length};
}

LawInfo info() {
  LawInfo out{.name = "jkr",
              .title = "Johnson–Kendall–Roberts adhesive contact",
              .equation =
                  "F = 4E*a³/(3R*) − √(8πWE*a³), δ = a²/R* − √(2πWa/E*); touches at δ = 0, breaks at δ = −0.75 X, "
                  "X = (π²W²R*/E*²)^(1/3)",
              .source = "Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141",
              .parameters = keys::elastic_parameters(),
              .keys = keys::elastic()};
  out.parameters.push_back(
      given_by_study("adhesion", "tension", "nN/µm", "Adhesion energy W per contact area of the pair; 0 gives Hertz contact."));
  out.keys.push_back({"", keys::adhesion()});
  return out;
}

}  // namespace

std::shared_ptr<const SphereLaw> jkr_law() {
  static const auto law = make_sphere_law<Jkr>(
      {.info = info(),
       .word = "jkr",
       .doc = "JKR, elastic with adhesion",
       .of_small_contacts = true,
       .couple = &couple,
       .rest_overlap = [](const PairContact& contact,
                          double reduced_radius) { return zero_load_overlap(pair_law(contact.coefficient, reduced_radius)); },
       .reach = &reach,
       .jumps = &jumps});
  return law;
}

}  // namespace morula::cbm

#include <algorithm>
#include <utility>

#include "cbm/laws/table.h"
#include "cbm/pair_loop.h"
#include "cbm/sphere_keys.h"

namespace morula::cbm {
namespace {

/// One pair after the other: lanes would look up eight places of the table, and each pair has the bits that it has alone. All pairs of a block have
/// the law of the first.
void evaluate(PairBlock& block) noexcept {
  const PairGeometry at = PairGeometry::of(block);
  const PairTable& table = *block.contact[0]->law->table;
  for (int lane = 0; lane < PairBlock::kWidth; ++lane) {
    const double radius = at.reduced_radius[lane], overlap = at.overlap[lane];
    const bool attached = block.attached[lane] > 0.0;
    const ContactResponse<double> out = table.respond(radius, overlap, attached);
    block.force[lane] = out.force, block.stiffness[lane] = out.stiffness, block.area[lane] = out.area, block.energy[lane] = out.energy;
    block.attached_next[lane] = table.attached_next(radius, overlap, attached);
  }
}

PairOutcome respond(const PairContact& contact, double reduced_radius, double overlap, bool attached) {
  const PairTable& table = *contact.law->table;
  return {table.respond(reduced_radius, overlap, attached), table.attached_next(reduced_radius, overlap, attached)};
}

/// All that the table says: the moduli and the adhesion of the study are not asked.
PairCoefficients couple(const SphereParameters& /*a*/, const SphereParameters* /*b*/, double /*adhesion*/) { return {}; }

double rest_overlap(const PairContact& contact, double reduced_radius) { return contact.law->table->rest_overlap() * reduced_radius; }

double reach(const PairContact& contact, double reduced_radius) {
  const PairTable& table = *contact.law->table;
  return table.adheres() ? std::max(0.0, -table.break_overlap() * reduced_radius) : 0.0;
}

std::vector<double> jumps(const PairContact& contact, double reduced_radius) {
  std::vector<double> out{contact.law->table->rest_overlap() * reduced_radius};
  for (const PairTableKnot& knot : contact.law->table->knots()) out.push_back(knot.overlap * reduced_radius);
  return out;
}

}  // namespace

LawInfo table_law_info() {
  LawInfo out{
      .name = "table",
      .title = "Contact of spheres by a table fitted to shells",
      .equation = "F = R* f(δ/R*), A = R*² g(δ/R*), U = R*² ∫ f; f and g monotone cubics; touches and breaks at overlaps of the table",
      .source = "choice of this project; monotone cubic of Fritsch & Carlson 1980, doi:10.1137/0717021",
      .parameters = keys::elastic_parameters(),
      .keys = keys::elastic()};
  for (LawParameter& parameter : out.parameters) parameter.doc += " Of contacts with obstacles and with spheres of other laws.";
  return out;
}

std::shared_ptr<const SphereLaw> table_law(PairTable table) {
  return std::make_shared<const SphereLaw>(SphereLaw{.info = table_law_info(),
                                                     .word = "table",
                                                     .doc = "a table of force and area, fitted to shells",
                                                     .table = std::make_shared<const PairTable>(std::move(table)),
                                                     .elsewhere = jkr_law(),
                                                     .couple = &couple,
                                                     .rest_overlap = &rest_overlap,
                                                     .reach = &reach,
                                                     .jumps = &jumps,
                                                     .evaluate = &evaluate,
                                                     .respond = &respond});
}

}  // namespace morula::cbm

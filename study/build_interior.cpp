#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "study/build.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// What a field that adds to what is outside has at the start, and on faces of the domain at any time; {0}: there is none [mM].
std::vector<double> levels_of_field(const BuildContext& c, const draft::Osmosis& d) {
  const auto field = std::ranges::find_if(c.draft.fields, [&](const auto& one) { return d.field.given && one.name == d.field.value; });
  if (field == c.draft.fields.end()) return {0.0};
  fields::FieldSpec spec;
  field->content.spec.write_to(spec);
  std::vector<double> out{spec.initial}, factors;
  for (const auto& point : field->content.course) factors.push_back(point.content.value.value);
  if (factors.empty()) factors.push_back(1.0);
  const draft::FieldBoundary& b = field->content.boundary;
  const std::array<const Given<double>*, 6> faces{&b.x_low, &b.x_high, &b.y_low, &b.y_high, &b.z_low, &b.z_high};
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Given<double>& face = faces[k]->given ? *faces[k] : b.all;
    if (c.study.model.space.periodic(static_cast<int>(k / 2)) || !face.known() || face.value < 0.0) continue;  // below 0: no flux
    for (const double factor : factors) out.push_back(face.value * factor);
  }
  return out;
}

/// The volumes that a medium leaves the cell at rest must be such as a shell can have, alone and with what a field is known to add.
void check_osmotic_volumes(BuildContext& c, const draft::Osmosis& d, const Osmosis& law) {
  constexpr double kLeast = 0.2, kMost = 10.0;
  std::vector<double> factors = law.course.value;
  if (factors.empty()) factors.push_back(1.0);
  const std::vector<double> levels = levels_of_field(c, d);
  for (std::size_t k = 0; k < factors.size() * levels.size(); ++k) {
    const std::size_t i = k / levels.size();
    const double of_field = levels[k % levels.size()], outside = law.outside * factors[i] + of_field;
    const double volume = law.inactive + (1.0 - law.inactive) * law.inside / std::max(outside, 1e-300);
    if (outside > 0.0 && volume >= kLeast && volume <= kMost) continue;
    const Place place = d.course.empty() ? (d.outside.given ? d.outside.place : d.inside.place) : d.course[i].content.value.place;
    const double most = (1.0 - law.inactive) * law.inside / std::max(0.01, kLeast - law.inactive);
    const double least = (1.0 - law.inactive) * law.inside / (kMost - law.inactive);
    c.diagnostics.error(536, place,
                        "an osmolarity of " + short_number(outside) + " mM outside" +
                            (d.field.given ? " (" + short_number(of_field) + " mM of it '" + d.field.value + "')" : std::string()) +
                            " would leave the cell at " +
                            (outside > 0.0 ? short_number(volume) + " times its target volume" : std::string("no finite volume")),
                        law.inactive >= kLeast
                            ? "at least " + short_number(std::ceil(least)) + " mM"
                            : "between " + short_number(std::ceil(least)) + " and " + short_number(std::floor(most)) + " mM");
    return;
  }
}

/// `most`: the links that there can be; 0: not known.
dcm::LinkParameters links_of(BuildContext& c, const draft::Links& d, std::uint64_t nodes, std::uint64_t most,
                             const std::string& type_name) {
  if (!d.present) return {};
  if (d.number.given && d.number.known() && d.number.value != std::numeric_limits<std::uint64_t>::max() && most > 0 &&
      d.number.value > most)
    c.diagnostics.error(
        539, d.number.place,
        "shells of '" + type_name + "' have " + std::to_string(nodes) + " nodes, not enough for " + d.number.text + " links",
        "at most " + std::to_string(most) + ", or `all`");
  dcm::LinkParameters out;
  out.count = static_cast<std::uint32_t>(std::min<std::uint64_t>(d.number.value, dcm::LinkParameters::kAll));
  out.stiffness = d.stiffness.value;
  out.damping = d.damping.value;
  d.law.write_to(out);
  return out;
}

void set_nucleus(BuildContext& c, const draft::CellType& t, const std::string& type_name, dcm::InteriorParameters& out) {
  constexpr double kWidest = 0.8;  // of the cell's radius: the faces of the coarsest mesh lie at 0.9
  const draft::Nucleus& d = t.nucleus;
  out.cytoplasm_viscosity = d.viscosity.value;
  if (d.radius.given == d.volume_fraction.given) {
    c.diagnostics.error(111, d.radius.given ? d.radius.place : d.kind.place, "a nucleus has a `radius` or a `volume_fraction`, one of them",
                        "for example `nucleus: {radius: 2.5 um}`");
    return;
  }
  const double cell = t.radius.mean.value;
  const double part = d.radius.given ? d.radius.value / std::max(cell, 1e-300) : std::cbrt(d.volume_fraction.value);
  const Given<double>& written = d.radius.given ? d.radius : d.volume_fraction;
  if (!written.known() || !t.radius.mean.known()) return;
  out.nucleus_fraction = part * part * part;
  if (part <= kWidest) return;
  const std::string where = "the nucleus of '" + type_name + "' (" + written.text + ") ";
  c.diagnostics.error(537, written.place,
                      where + (part >= 1.0 ? "is larger than the cell" : "leaves no room between itself and the cortex") +
                          ", whose radius is " + t.radius.mean.text,
                      d.radius.given ? "at most " + short_number(kWidest * cell) + " um" : "at most 50 %");
}

/// Mesh and mechanics of a nucleus that is a shell, whose size is known.
void set_nuclear_shell(BuildContext& c, const draft::CellType& t, const std::string& type_name, dcm::InteriorParameters& out) {
  const draft::ShellKeys& d = t.nucleus.shell;
  const std::string whose = "the nucleus of '" + type_name + "'";
  out.nucleus_shell = build_shell(c, type_name, d, 0.0);
  if (!d.nodes.known() || !t.radius.mean.known() || out.nucleus_fraction == 0.0) return;
  out.nucleus_nodes = static_cast<std::uint32_t>(d.nodes.value);
  if (d.bulk_modulus.known() && d.bulk_modulus.value == 0.0)
    c.diagnostics.error(591, d.bulk_modulus.place, whose + " has no resistance to changes of its volume",
                        "a `bulk_modulus` above 0, for example `10 kPa`");
  const double radius = std::cbrt(out.nucleus_fraction) * t.radius.mean.value;
  // The pressure of the cytosol and of its own tension: the volume gives way without end where that rises faster than the volume's (E572).
  const double least = 2.0 * d.tension.value / (3.0 * radius), cytosol = 2.0 * t.tension.value / t.radius.mean.value;
  if (d.bulk_modulus.value > 0.0 && d.bulk_modulus.value <= std::max(least, cytosol))
    c.diagnostics.error(591, d.bulk_modulus.given ? d.bulk_modulus.place : d.tension.place,
                        whose + " would collapse: its volume (K = " + d.bulk_modulus.text + ") does not resist the tension around it",
                        "`bulk_modulus` of at least " + short_number(3.0 * std::max(least, cytosol)) + " kPa, or less tension");
  // Between its nodes the surface lies as deep as edge²/(8 R) under the ball; the contact is to see that.
  const double edge = mean_edge(d.nodes.value) * radius, depth = edge * edge / (8.0 * radius);
  const Given<double>& range = c.draft.contact.range;
  if (range.known() && depth > 0.5 * range.value)
    c.diagnostics.error(592, d.nodes.given ? d.nodes.place : t.nucleus.kind.place,
                        whose + " is too coarse with " + d.nodes.text + " nodes: its faces lie up to " +
                            short_number(std::round(100.0 * depth) / 100.0) +
                            " um under the ball that they stand for, more than half of the contact range",
                        d.nodes.value < 162 ? "`nodes: 162`" : "more `nodes`, or a longer `contact.range`");
}

}  // namespace

dcm::InteriorParameters build_interior(BuildContext& c, const draft::CellType& t, const std::string& type_name) {
  dcm::InteriorParameters out;
  const bool is_shell = t.nucleus.present && t.nucleus.kind.value == "shell";
  const bool has_nucleus = is_shell || (t.nucleus.present && t.nucleus.kind.value == "rigid");
  if (has_nucleus) set_nucleus(c, t, type_name, out);
  if (is_shell) set_nuclear_shell(c, t, type_name, out);
  for (const Named<bool>& key : t.nucleus.no_effect)
    c.diagnostics.error(590, key.place, "'" + key.name + "' has no effect on a nucleus of `kind: " + t.nucleus.kind.value + "`",
                        "`kind: shell`, or leave it away");
  if (t.osmosis.present && t.osmosis.inactive.known() && out.nucleus_fraction > t.osmosis.inactive.value)
    c.diagnostics.error(540, t.osmosis.inactive.given ? t.osmosis.inactive.place : t.nucleus.kind.place,
                        "the nucleus of '" + type_name + "' is " + short_number(100.0 * out.nucleus_fraction) +
                            " % of the cell, but only " + t.osmosis.inactive.text + " are inactive",
                        "`osmosis.inactive` of at least the nucleus' part, or a smaller nucleus");
  const std::uint64_t nodes = t.nodes.known() ? t.nodes.value : 0;
  out.nucleus_links = links_of(c, t.nucleus_links, nodes, nodes, type_name);
  out.cortex_links = links_of(c, t.cortex_links, nodes, nodes / 2, type_name);  // one for a pair of opposite nodes
  if (t.nucleus_links.present && !has_nucleus)
    c.diagnostics.error(538, t.nucleus_links.stiffness.place, "shells of '" + type_name + "' have links to a nucleus, but no nucleus",
                        "add for example `nucleus: {radius: 2.5 um}` to `dcm`, or use `cortex_links`");
  return out;
}

void build_osmosis(BuildContext& c, const draft::CellType& t, CellType& type) {
  if (t.bulk_modulus.known() && t.bulk_modulus.value == 0.0)
    c.diagnostics.error(535, t.bulk_modulus.place, "shells of '" + type.name + "' have no resistance to changes of their volume",
                        "a `bulk_modulus` above 0, for example `2.5 kPa`");
  const draft::Osmosis& d = t.osmosis;
  if (!d.present) return;
  Osmosis& law = type.osmosis;
  d.law.write_to(law);
  law.inactive = d.inactive.value;
  law.inside = d.inside.value;
  law.outside = d.outside.value;
  law.course = build_course(c, d.course);
  if (d.field.given && d.field.known()) law.field = find_field(c, d.field.value, d.field.place);
  if (d.inactive.known() && d.inside.known() && d.outside.known()) check_osmotic_volumes(c, d, law);
}

}  // namespace morula::scenarios

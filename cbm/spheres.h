#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "cbm/crowded_area.h"
#include "cbm/packing.h"
#include "cbm/partners.h"
#include "cbm/sphere_law.h"
#include "core/column.h"
#include "core/vec3.h"

namespace morula::cbm {

/// All spheres of a rank: what a checkpoint holds of them. Spheres come in the order of their cells.
struct Spheres {
  std::vector<Vec3d> position;      ///< [µm]
  std::vector<double> radius;       ///< [µm]
  std::vector<std::uint16_t> type;  ///< cell type
  std::vector<Vec3f> velocity;      ///< last solution, the solver's start [µm/s]
  /// Partners to which the sphere adheres (the JKR branch flag of the pair), sorted; both partners carry the entry.
  PartnerLists attached;

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// One sphere by itself: what a cell carries along when it divides, changes its body or moves to another rank.
struct SphereRecord {
  Vec3d position{};
  double radius = 0.0;
  Vec3f velocity{};
  Partners attached{};
  std::uint16_t type = 0;  ///< that of its cell, which gives it
};

// --- Columns: what a sphere has, declared once; records, messages between ranks, checkpoint, state hash and memory walk them. As in dcm/shells.h.

/// One value of each sphere.
template <class T>
using ColumnOfSpheres = ColumnOfBodies<T, Spheres, SphereRecord>;

/// The cells to which each sphere adheres.
struct ColumnOfPartners {
  using Value = CellId;
  static constexpr Fill kFill = Fill::kAny;
  const char* name;
  const char* unit;
  ColumnRules rules{};

  [[nodiscard]] static std::span<const CellId> values(const Spheres& spheres, std::size_t i) { return spheres.attached[i]; }
  [[nodiscard]] static std::span<const CellId> values(const SphereRecord& sphere) { return sphere.attached; }
  static void append(Spheres& spheres, std::span<const CellId> values) { spheres.attached.push_back(values); }
  static void append(Spheres& spheres, const Spheres& from, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) spheres.attached.push_back(from.attached[i]);
  }
  static void give(SphereRecord& sphere, std::span<const CellId> values) { sphere.attached.assign(values.begin(), values.end()); }
  static void copy(Spheres& spheres, const Spheres& from) { spheres.attached = from.attached; }
  static void reserve(Spheres& spheres, std::size_t count) { spheres.attached.reserve(count, 0); }
  [[nodiscard]] static std::size_t memory(const Spheres& spheres) { return spheres.attached.memory(); }
};

/// visit(column) for all columns of spheres, in the order of the state hash.
template <class Visit>
void for_each_sphere_column(Visit&& visit) {
  visit(ColumnOfSpheres<Vec3d>{"position", "um", &Spheres::position, &SphereRecord::position});
  visit(ColumnOfSpheres<double>{"radius", "um", &Spheres::radius, &SphereRecord::radius, {.grows = true}});
  visit(ColumnOfSpheres<std::uint16_t>{"type", "1", &Spheres::type, &SphereRecord::type});
  visit(ColumnOfSpheres<Vec3f>{"velocity", "um/s", &Spheres::velocity, &SphereRecord::velocity});
  visit(ColumnOfPartners{"attached", "1"});
}

/// Sphere i by itself.
inline SphereRecord sphere_out_of(const Spheres& spheres, std::size_t i) {
  SphereRecord out;
  for_each_sphere_column([&](const auto& column) { column.give(out, column.values(spheres, i)); });
  return out;
}
/// Adds a sphere behind the others.
inline void add_sphere(Spheres& spheres, const SphereRecord& sphere) {
  for_each_sphere_column([&](const auto& column) { column.append(spheres, column.values(sphere)); });
}
/// Adds the spheres first, …, last − 1 of `from` behind the others.
inline void add_spheres(Spheres& spheres, const Spheres& from, std::size_t first, std::size_t last) {
  for_each_sphere_column([&](const auto& column) { column.append(spheres, from, first, last); });
}
/// Bytes of all columns.
inline std::size_t memory_of(const Spheres& spheres) {
  std::size_t bytes = 0;
  for_each_sphere_column([&](const auto& column) { bytes += column.memory(spheres); });
  return bytes;
}

/// Contact of a sphere with a shell, over what follows from its modulus and from W: fitted by pairs of both, or chosen.
struct WithShells {
  double stiffness = 1.0;  ///< of its foundation (sphere_foundation() in core/contact/traction_law.h)
  double adhesion = 1.0;   ///< of W
};

/// Parameters of a sphere, for the contact laws. Every sphere has the moduli of the cell as a whole, which its contact with surfaces takes, too.
struct SphereParameters {
  double young = 0.45;                               ///< E [kPa]
  double poisson = 0.4;                              ///< ν
  std::shared_ptr<const SphereLaw> law = jkr_law();  ///< of contact with spheres and obstacles
  LawValues own{};                                   ///< values of the law's own keys
  PackingCurve packing{};                            ///< pressure by packing; empty: none
  CrowdedArea crowded_area{};                        ///< contact areas that are told; empty: those of pairs
  double adhesion_factor = 1.0;                      ///< W of two spheres over that of the study: of a law fitted to shells
  double approach_factor = 1.0;                      ///< γ_n with cells over that of the study: `friction.approach`, or of a fitted law
  double along_factor = 1.0;                         ///< γ_t, likewise
  WithShells with_shells{};
  OverlapRange fitted{};  ///< of contacts with spheres that have a fitted law, too
};

}  // namespace morula::cbm

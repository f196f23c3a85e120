#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mark_sets.h"
#include "core/numbers/time_course.h"
#include "core/vec3.h"

namespace morula {

/// Which faces of the shells of a type carry a mark. Several rules may give one mark.
struct FaceMark {
  enum class Rule : std::uint8_t {
    kCone,     ///< the way from the cell's centroid to the face's makes less than `angle` with the axis
    kBand,     ///< the face's centroid is less than `half_width` from the plane through the cell's, across the axis
    kBall,     ///< the face's centroid is within a ball of the laboratory
    kBox,      ///< likewise, a box
    kTouched,  ///< in contact with a material
  };
  enum class Axis : std::uint8_t { kGiven, kPolarity, kTowardPoint };

  int mark = 0;            ///< number of its name in Model::mark_names
  std::uint16_t type = 0;  ///< cell type
  Rule rule = Rule::kCone;
  Axis axis_from = Axis::kGiven;
  Vec3d axis{0, 0, 1};      ///< of length 1
  double angle = 0.0;       ///< [rad]
  double half_width = 0.0;  ///< [µm]
  Vec3d center{}, size{};   ///< of a ball or box, or the point that the axis points to [µm]
  double radius = 0.0;      ///< [µm]
  int material = -1;        ///< kTouched: cell type, or obstacle after the types
  bool always = false;      ///< follows the cell from step to step; else given once, when the shell comes to be
  bool keep = false;        ///< with `always`: what was marked stays marked
};

/// Cortical tension of a part of the surface of a type's shells.
struct TensionRegion {
  static constexpr int kWhole = -1, kLateral = -2;

  int mark = kWhole;       ///< bit of the mark; the whole surface; or what is in contact with other cells
  double tension = 0.0;    ///< γ [nN/µm]
  TimeCourse course;       ///< factor over time; empty: 1
  double amplitude = 0.0;  ///< of the modulation, 0 to 1
  double period = 0.0;     ///< of the modulation; 0: none [s]
  double phase = 0.0;      ///< [rad]

  /// γ(t) = γ·course(t)·(1 + a sin(2πt/T + φ)) [nN/µm].
  [[nodiscard]] double at(double time) const;
  [[nodiscard]] double least() const;  ///< at any time [nN/µm]
  [[nodiscard]] bool varies() const { return !course.empty() || period > 0.0; }
};

/// The regions of a type. Of those whose mark a face carries the first one holds, the cell's own tension (or kWhole) where there is none; contact
/// with other cells goes from that to the lateral tension, as the eased part in contact does (dcm.md §4).
struct RegionalTension {
  std::vector<TensionRegion> regions;
  double easing = 60.0;  ///< time in which a face that comes into contact takes the lateral tension [s]
  /// A fluid surface bears no difference of tension: what contact lowers it by is an energy of the contact, and surfaces adhere by that
  /// (decision 0084). Not where tensions or adhesion differ by marks.
  bool lateral_adheres = false;

  [[nodiscard]] bool empty() const { return regions.empty(); }
  [[nodiscard]] bool varies() const;
  /// Faces have the lateral tension as far as their eased contact says.
  [[nodiscard]] bool eases_contact() const { return lateral() != nullptr && !lateral_adheres; }
  /// Tension of a face that carries these marks and is in contact with other cells by this part [nN/µm].
  [[nodiscard]] double of_face(double own, MarkSet marks, double contact, double time) const;
  /// What contact with other cells takes from the tension of surfaces that adhere by it; 0: of others [nN/µm].
  [[nodiscard]] double drop_in_contact(double own, double time) const;
  [[nodiscard]] const TensionRegion* lateral() const;  ///< null: contact changes no tension
};

/// A cavity between cells whose fluid presses on the faces that look into it (dcm.md §15; fields_and_coupling.md B).
struct Lumen {
  std::string name;
  int mark = 0;  ///< bit of the faces that bound it, renewed by sight from `center`, unless the faces are those of a mark of the study
  bool by_sight = true;       ///< faces are found by sight
  Vec3d center{};             ///< where its fluid is looked at from [µm]
  double reach = 100.0;       ///< how far the eye sees [µm]
  double renewed = 300.0;     ///< time after which the faces are found anew [s]
  double from = 0.0;          ///< it exists from here [s]
  double pressure = 0.0;      ///< P, or that at its first volume where the solute is kept [kPa]
  bool keeps_solute = false;  ///< P = R T n/V with the amount n of its first volume; else P whatever the volume
  TimeCourse course;          ///< factor of the pressure (of the amount of solute) over time; empty: 1
};

}  // namespace morula

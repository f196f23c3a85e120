#pragma once
#include <cstdint>
#include <string>

namespace morula::dcm {

struct SheetLaw;

/// What makes a shell's state unusable; a step that leads there is tried again with a smaller one.
enum class ShellFaultKind : std::uint8_t {
  kNone,
  kNotFinite,      ///< a position is not a number; element: node
  kVolume,         ///< enclosed volume not positive (volume_pressure)
  kTriangleShape,  ///< quality q below ShellLimits::kQuality (triangle_shape); element: face
  kDihedral,       ///< |θ| above ShellLimits::kAngle (dihedral_barrier); element: edge
  kStretch,        ///< strain outside the range of a sheet's law; element: face
};

struct ShellFault {
  ShellFaultKind kind = ShellFaultKind::kNone;
  std::uint32_t element = 0;      ///< node, face or edge within the shell
  const SheetLaw* law = nullptr;  ///< of kStretch

  explicit operator bool() const { return kind != ShellFaultKind::kNone; }
  friend bool operator==(const ShellFault&, const ShellFault&) = default;
};

/// Beyond these a surface folds and the sign of the contact gap flips (time_stepping.md §9.6).
struct ShellLimits {
  static constexpr double kQuality = 0.2;
  static constexpr double kAngle = 2.9;  ///< [rad]
};

/// "triangle_shape: quality of face 17 is below 0.2", for messages.
std::string describe(const ShellFault& fault);

}  // namespace morula::dcm

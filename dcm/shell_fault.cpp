#include "dcm/shell_fault.h"

namespace morula::dcm {

std::string describe(const ShellFault& fault) {
  const std::string element = std::to_string(fault.element);
  switch (fault.kind) {
    case ShellFaultKind::kNone:
      return "no fault";
    case ShellFaultKind::kNotFinite:
      return "position of node " + element + " is not a finite number";
    case ShellFaultKind::kVolume:
      return "volume_pressure: the enclosed volume is not positive";
    case ShellFaultKind::kTriangleShape:
      return "triangle_shape: quality of face " + element + " is below 0.2";
    case ShellFaultKind::kDihedral:
      return "dihedral_barrier: edge " + element + " is folded beyond 2.9 rad";
    case ShellFaultKind::kStretch:
      return "st_venant_kirchhoff: face " + element + " is stretched beyond 0.8 to 1.3, where the law softens; neo_hooke holds there";
  }
  return "unknown fault";
}

}  // namespace morula::dcm

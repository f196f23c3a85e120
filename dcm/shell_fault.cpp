#include "dcm/shell_fault.h"

#include "dcm/sheet_law.h"

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
      return (fault.law != nullptr ? fault.law->name : "sheet") + ": face " + element + " " +
             (fault.law != nullptr ? fault.law->limit : "is strained beyond the range of its law");
  }
  return "unknown fault";
}

}  // namespace morula::dcm

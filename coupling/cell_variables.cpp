#include "coupling/cell_variables.h"

namespace morula {

std::vector<CellVariable> cell_variables(const Model& model) {
  std::vector<CellVariable> out;
  for (const fields::FieldSpec& field : model.fields) {
    out.push_back({"amount/" + field.name, "amol", AtDivision::kShared});
    out.push_back({"concentration/" + field.name, "mM", AtDivision::kCopied});
  }
  return out;
}

}  // namespace morula

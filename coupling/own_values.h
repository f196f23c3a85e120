#pragma once
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/cell_id.h"
#include "core/law_values.h"
#include "core/numbers/time_course.h"
#include "core/vec3.h"

namespace morula {

/// What a study gives the keys of a thing that declares them itself (core/own_keys.h), in internal units. A number that is not given and has no default
/// is not a number.
class OwnValues : public LawValues {
 public:
  void set_vector(const std::string& name, const Vec3d& value) { vectors_[name] = value; }
  void set_name(const std::string& key, std::string name) { names_[key] = std::move(name); }
  void set_course(const std::string& name, TimeCourse value) { courses_[name] = std::move(value); }
  void set_ids(const std::string& name, std::vector<CellId> value) { ids_[name] = std::move(value); }

  /// 0 where it is not given.
  [[nodiscard]] Vec3d vector(const std::string& name) const {
    const auto at = vectors_.find(name);
    return at != vectors_.end() ? at->second : Vec3d{};
  }
  /// Empty where it is not given.
  [[nodiscard]] TimeCourse course(const std::string& name) const {
    const auto at = courses_.find(name);
    return at != courses_.end() ? at->second : TimeCourse{};
  }
  /// Empty where none is given.
  [[nodiscard]] std::span<const CellId> ids(const std::string& name) const {
    const auto at = ids_.find(name);
    return at != ids_.end() ? std::span(at->second) : std::span<const CellId>();
  }
  /// Of a field or a mark, as the study has it, for messages; empty where none is given.
  [[nodiscard]] std::string name(const std::string& key) const {
    const auto at = names_.find(key);
    return at != names_.end() ? at->second : std::string();
  }
  /// Of a field, a mark or a word; −1 where none is given.
  [[nodiscard]] int number(std::string_view name) const { return has(name) ? static_cast<int>((*this)(name)) : -1; }
  [[nodiscard]] bool flag(std::string_view name) const { return has(name) && (*this)(name) != 0.0; }
  [[nodiscard]] const std::map<std::string, TimeCourse>& courses() const { return courses_; }

 private:
  std::map<std::string, Vec3d> vectors_;
  std::map<std::string, std::string> names_;
  std::map<std::string, TimeCourse> courses_;
  std::map<std::string, std::vector<CellId>> ids_;
};

}  // namespace morula

#pragma once
#include <map>
#include <vector>

#include "study/draft_regions.h"
#include "study/section.h"

namespace morula::scenarios::draft {

/// What a study says in the section of a thing that declares its keys itself (core/own_keys.h), by the names of the keys; of a group within it by
/// `group.key`.
struct OwnSection {
  bool present = false;
  std::map<std::string, Given<double>> numbers;
  std::map<std::string, Given<std::string>> texts;
  std::map<std::string, Given<bool>> flags;
  std::map<std::string, Given<Vec3d>> vectors;
  std::map<std::string, Given<std::vector<std::string>>> lists;
  std::map<std::string, std::vector<Named<CoursePoint>>> courses;
  std::map<std::string, bool> groups;
};

}  // namespace morula::scenarios::draft

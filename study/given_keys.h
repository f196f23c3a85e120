#pragma once
#include <functional>
#include <string>
#include <vector>

#include "study/section.h"

namespace morula::scenarios {

/// A key that the study gives, as `cortex.tension` within the section that is looked at.
struct GivenKey {
  std::string path;
  Place place;
};

/// The keys of a section that the study gives, in the order of their declaration, which `describe` makes.
std::vector<GivenKey> keys_written_in(const Laws& laws, const std::function<void(Section&)>& describe);

}  // namespace morula::scenarios

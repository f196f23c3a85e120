#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "study/build.h"

namespace morula::scenarios {
namespace {

/// A bare word after `against` is a theory; a number stays a number. The file of data becomes an input file of the study (E601–E605).
void build_expected(BuildContext& c, ExpectedValue& against) {
  const std::string& value = against.value.value;
  if (against.value.known() && !against.theory.given && !value.empty() &&
      (std::isalpha(static_cast<unsigned char>(value[0])) != 0 || value[0] == '_')) {
    against.theory = against.value;
    against.value = {};
  }
  if (!against.data.known()) return;
  const Place place = against.data.place;
  against.data.value = add_input_file(c, against.data);
  (void)read_text_file(against.data.value, against.data.value, kMaxCsvBytes, place, c.diagnostics);
}

/// What has no meaning beside what is given is not written into the resolved study.
void drop_unused(MeasuredMoments& moments, ExpectedValue& against) {
  if ((moments.from.given || moments.until.given) && !moments.at.given) moments.at.text.clear();
  if (!against.data.given && !against.x.given) against.x.text.clear();
}

/// What needs several moments is asked of one: E515.
void check_course(BuildContext& c, const MeasuredMoments& m) {
  constexpr std::array kOfCourse{"rise", "growth", "slope", "change", "left", "rising", "falling"};
  const std::string& at = m.at.value;
  const bool several = m.from.given || m.until.given || at == "every" || at.starts_with("holds");
  if (!several && std::ranges::find(kOfCourse, m.over_time.value) != kOfCourse.end())
    c.diagnostics.error(515, m.over_time.place, "'" + m.over_time.value + "' finds nothing at one moment alone",
                        "give `from` and `until`, or `at: every`");
}

}  // namespace

void build_criteria(BuildContext& c) {
  for (auto& [name, place, criterion] : c.draft.criteria) {
    criterion.place = place;
    build_expected(c, criterion.over);
    build_expected(c, criterion.against);
    if (!criterion.over.data.given) criterion.over.x.text.clear();
    check_course(c, criterion.moments);
    drop_unused(criterion.moments, criterion.against);
    c.study.criteria.push_back(criterion);
  }
  for (auto& [name, place, plot] : c.draft.plots) {
    plot.place = place;
    build_expected(c, plot.against);
    drop_unused(plot.moments, plot.against);
    c.study.plots.push_back(plot);
  }
}

}  // namespace morula::scenarios

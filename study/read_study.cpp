#include "coupling/cell_variables.h"
#include "study/build.h"
#include "study/catalogue.h"
#include "study/declare.h"
#include "study/document.h"
#include "study/law_faults.h"
#include "study/read_section.h"
#include "study/study.h"
#include "study/write_section.h"

namespace morula::scenarios {
namespace {

/// How much larger a study may be that a run has written itself: all its defaults are written out.
constexpr unsigned kResolvedGrows = 20;

void read_draft(const Node& document, const std::shared_ptr<const SourceText>& source, const Laws& laws, draft::Study& draft,
                Diagnostics& diagnostics) {
  const UnitSystem units;
  ReadSection section(&document, Place{source, 1, 1, 1}, "", laws, units, diagnostics);
  declare_study(section, draft);
  section.finish();
}

void build(BuildContext& context) {
  build_domain(context);
  build_cell_types(context);
  build_geometry(context);
  build_initial(context);  // a table of cells says of some that they are shells
  build_pairs(context);
  build_contact_pairs(context);
  build_fields(context);
  build_coupling(context);
  build_time_and_numerics(context);
  build_activity(context);
  build_regions(context);
  build_adhesion_regions(context);
  build_repulsion(context);
  build_loads(context);
  build_tolerance(context);
  number_trait_variables(context.study.model);
  check_whole(context);
  Study& study = context.study;
  const draft::Study& draft = context.draft;
  study.name = draft.name.value;
  study.title = draft.title.value;
  study.scenario = draft.scenario.value;
  study.output = {draft.output.series.value, draft.output.formats.value, draft.output.report.value};
  build_criteria(context);
  check_places(context);
}

Result<Study, Diagnostics> read_source(const std::shared_ptr<const SourceText>& source, const std::filesystem::path& folder,
                                       const std::filesystem::path& shown_folder, const ReadOptions& options, Diagnostics diagnostics) {
  Node document = parse_document(source, diagnostics, options.judge_places ? kMaxNodes : kResolvedGrows * kMaxNodes);
  if (document.kind == Node::Kind::kNull) return diagnostics;  // what could not be parsed has been told
  if (document.kind != Node::Kind::kMap) {
    diagnostics.error(104, document.place, "a study is a map (`key: value`)", "`morula new` writes one to start from");
    return diagnostics;
  }
  if (options.laws != builtin_laws()) {
    const std::vector<std::string> faults = law_faults(*options.laws);
    for (const std::string& fault : faults)
      diagnostics.error(692, document.place, "this program brings laws that cannot be used: " + fault, "its author can mend it");
    if (!faults.empty()) return diagnostics;
  }
  draft::Study draft;
  if (document.cut_off) {  // the mistakes in what was read are told; what it means together cannot be judged
    read_draft(document, source, *options.laws, draft, diagnostics);
    diagnostics.sort();
    return diagnostics;
  }
  const Declaration declared = study_declarations(*options.laws);
  for (const std::string& assignment : options.overrides) apply_override(document, declared, assignment, diagnostics);
  expand_likes(document, declared, diagnostics);

  Study study;
  study.laws = options.laws;
  read_draft(document, source, *options.laws, draft, diagnostics);
  BuildContext context{draft, study, diagnostics, folder, options, shown_folder};
  build(context);
  if (options.check_criteria && !diagnostics.has_errors()) options.check_criteria(study, diagnostics);
  study.resolved_text = write_study(draft, *options.laws);
  if (!diagnostics.has_errors()) check_fitted_laws(context);
  diagnostics.sort();
  if (options.strict) diagnostics.warnings_to_errors();
  if (diagnostics.has_errors()) return diagnostics;
  study.source_path = source->name;
  study.source_text = source->bytes;
  study.warnings = std::move(diagnostics);
  return study;
}

}  // namespace

Result<Study, Diagnostics> read_study(const std::filesystem::path& path, const ReadOptions& options) {
  Diagnostics diagnostics;
  const std::uintmax_t most = options.judge_places ? kMaxStudyBytes : kResolvedGrows * kMaxStudyBytes;
  const auto source = read_text_file(path, path.string(), most, {}, diagnostics);
  if (!source) return diagnostics;
  std::error_code ignored;
  return read_source(source, std::filesystem::absolute(path, ignored).parent_path(), path.parent_path(), options, std::move(diagnostics));
}

Result<Study, Diagnostics> read_study_text(const std::string& shown_name, const std::string& text, const std::filesystem::path& folder,
                                           const ReadOptions& options) {
  return read_source(std::make_shared<const SourceText>(shown_name, text), folder, {}, options, {});
}

}  // namespace morula::scenarios

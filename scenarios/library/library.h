#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace morula::scenarios {

/// One file of a library study, as it lies in scenarios/library/<name>/, carried inside the program.
struct TemplateFile {
  std::string_view path;     ///< relative to the study's folder
  std::string_view content;  ///< its bytes
};

/// A library study: the folder that `morula new <name>` makes.
struct Template {
  std::string_view name;
  std::span<const TemplateFile> files;  ///< sorted by path

  /// The `title` of its study.yaml: one line for people.
  [[nodiscard]] std::string title() const;
};

/// All library studies, sorted by name. To add one, add a folder with a study.yaml to scenarios/library.
std::span<const Template> templates();

/// The template of this name, or null.
const Template* find_template(std::string_view name);

/// Writes files below a folder, which is made where it is missing. Errors: kFile.
Status write_files(std::span<const TemplateFile> files, const std::filesystem::path& folder);

/// Names of all templates: what `scenario:` in a study file may say.
std::vector<std::string> template_names();

}  // namespace morula::scenarios

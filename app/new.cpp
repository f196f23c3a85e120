#include <filesystem>

#include "app/verbs.h"
#include "app/words.h"
#include "core/shell_word.h"
#include "results/file_io.h"
#include "scenarios/library/library.h"
#include "study/diagnostics.h"

namespace morula::app {
namespace fs = std::filesystem;
namespace {

std::string list_of_templates() {
  std::vector<std::vector<std::string>> rows;
  for (const scenarios::Template& one : scenarios::templates()) rows.push_back({std::string(one.name), one.title()});
  return table_text(rows);
}

}  // namespace

Status make_new(const NewOptions& options, const Context& context) {
  if (options.template_name.empty()) {
    context.console.result(list_of_templates());
    return {};
  }
  const scenarios::Template* one = scenarios::find_template(options.template_name);
  if (!one)
    return Error{ErrorKind::kInput, "there is no template '" + options.template_name + "'",
                 scenarios::suggest(options.template_name, scenarios::template_names())};
  const fs::path folder = options.folder.empty() ? fs::path(one->name) : fs::path(options.folder);
  std::error_code error;
  if (fs::exists(folder, error))
    return Error{ErrorKind::kFile, "'" + folder.string() + "' exists already",
                 "name another folder: `morula new " + std::string(one->name) + " DIR`"};
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), error);
  if (error) return scenarios::file_error(folder.parent_path(), "create", error.value());
  if (!fs::create_directory(folder, error) || error) return scenarios::file_error(folder, "create", error.value());
  if (Status written = scenarios::write_files(one->files, folder); !written.ok()) {
    fs::remove_all(folder, error);  // the folder is ours: it did not exist a moment ago
    return written;
  }
  std::string made;
  for (const scenarios::TemplateFile& file : one->files) made += (folder / file.path).string() + "\n";
  context.console.result(made);
  context.console.note("next: `cd " + shell_word(folder.string()) + "`, `morula check study.yaml --estimate`, `morula run study.yaml`");
  return {};
}

}  // namespace morula::app

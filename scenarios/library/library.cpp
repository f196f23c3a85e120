#include "scenarios/library/library.h"

#include <algorithm>

#include "results/file_io.h"

namespace morula::scenarios {

std::string Template::title() const {
  constexpr std::string_view key = "title:";
  for (const TemplateFile& file : files) {
    if (file.path != "study.yaml") continue;
    for (std::string_view rest = file.content; !rest.empty();) {
      std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), line.size() + 1));
      if (line.substr(0, key.size()) != key) continue;
      line.remove_prefix(key.size());
      const std::size_t first = line.find_first_not_of(" \"'");
      const std::size_t last = line.find_last_not_of(" \"'\r");
      return first == std::string_view::npos ? "" : std::string(line.substr(first, last - first + 1));
    }
  }
  return "";
}

const Template* find_template(std::string_view name) {
  const auto all = templates();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Template& t) { return t.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Status write_files(std::span<const TemplateFile> files, const std::filesystem::path& folder) {
  for (const TemplateFile& file : files) {
    const std::filesystem::path path = folder / file.path;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return file_error(path.parent_path(), "create", error.value());
    MORULA_TRY(write_file_atomically(path, file.content));
  }
  return {};
}

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const Template& t : templates()) names.emplace_back(t.name);
  return names;
}

}  // namespace morula::scenarios

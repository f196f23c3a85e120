#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace morula::scenarios {

/// The bytes of an input file (or of one `key=value` of the command line), and where its lines begin.
struct SourceText {
  std::string name;  ///< as the user wrote it
  std::string bytes;
  std::vector<std::size_t> line_begin;

  SourceText(std::string name, std::string bytes);
  /// The line with this number (from 1), without its end.
  [[nodiscard]] std::string_view line(int number) const;
  /// Number of characters that begin before this byte; quick at any place of a line of any length.
  [[nodiscard]] std::size_t characters_before(std::size_t byte) const;
  /// The first byte of the character with this number (from 0), or the end.
  [[nodiscard]] std::size_t byte_of(std::size_t character) const;

 private:
  std::vector<std::size_t> block_characters_;  ///< that begin before each block of bytes
};

/// A stretch of an input text. Lines and columns count from 1, columns and lengths in characters (code points); line 0 means the whole file.
struct Place {
  std::shared_ptr<const SourceText> source;
  int line = 0;
  int column = 0;
  int length = 1;
};

/// The place that begins at this byte of a text and is `bytes` long; it is cut at the end of its line.
Place place_at(std::shared_ptr<const SourceText> source, std::size_t byte, std::size_t bytes);

enum class Severity : std::uint8_t { kError, kWarning };

/// One message for the user: what is wrong, where, and what would be right.
struct Diagnostic {
  Severity severity = Severity::kError;
  int code = 0;  ///< one of `error_codes()`
  Place place;
  std::string text;
  std::string help;
};

/// All messages of a check, as a compiler would give them. Of very many only the first thousand are kept, the others counted.
class Diagnostics {
 public:
  void error(int code, Place place, std::string text, std::string help = {});
  void warning(int code, Place place, std::string text, std::string help = {});
  void append(Diagnostics other);

  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] bool has_errors() const { return error_count() > 0; }
  [[nodiscard]] std::size_t error_count() const { return errors_; }
  [[nodiscard]] std::size_t warning_count() const { return warnings_; }
  /// Whether further errors are only counted: their words need not be made.
  [[nodiscard]] bool full() const;
  [[nodiscard]] const std::vector<Diagnostic>& list() const { return list_; }

  /// Order by place, the study file first; messages of one place stay in the order they were found, and the same message of one place
  /// (a value that several sections share) is kept once.
  void sort();
  /// `--strict`: every warning becomes an error.
  void warnings_to_errors();
  /// The messages in the form `file:line:col: error: text [Ennn]`, source line, caret, help; ANSI colours if asked. At most a hundred,
  /// errors before warnings, and then how many more there are.
  [[nodiscard]] std::string text(bool colour = false) const;
  /// What the program's exit code follows from: kFile if all errors are missing files, else kInput.
  [[nodiscard]] ErrorKind kind() const;
  /// One error for callers that do not show them all.
  [[nodiscard]] Error as_error() const;

 private:
  void add(Diagnostic&& diagnostic);

  std::vector<Diagnostic> list_;
  std::size_t errors_ = 0, warnings_ = 0;            ///< all of them
  std::size_t kept_errors_ = 0, kept_warnings_ = 0;  ///< in the list
};

/// Limits of what is read at all.
inline constexpr std::uintmax_t kMaxStudyBytes = 5u << 20;
inline constexpr std::uintmax_t kMaxCsvBytes = 500u << 20;

/// Read a text file: it must exist, be a regular file, not be larger than `max_bytes` (looked at before reading), hold no NUL byte and be
/// UTF-8. A byte order mark is dropped. Errors (E601–E605) are added to `diagnostics` at `referred_from`, or at the file itself when that
/// is empty; then the result is null.
std::shared_ptr<const SourceText> read_text_file(const std::filesystem::path& path, const std::string& shown_name, std::uintmax_t max_bytes,
                                                 const Place& referred_from, Diagnostics& diagnostics);

/// Number of single-character edits (insert, delete, replace, swap of neighbours) between two words.
std::size_t edit_distance(std::string_view a, std::string_view b);
/// Help line for a word that is not allowed: "did you mean `x`?" when one is within two edits, else "allowed: a, b, c".
std::string suggest(std::string_view word, const std::vector<std::string>& allowed);

}  // namespace morula::scenarios

#pragma once
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace morula {

/// What kind of failure an error is; `app/` turns it into the exit code of the program (UX: 0 done ... 130 interrupted).
enum class ErrorKind {
  kInternal,      ///< a defect of Morula (exit 1)
  kInput,         ///< a command or study that is wrong (exit 2)
  kFile,          ///< a file is missing, or the target exists (exit 3)
  kPhysics,       ///< a physics limit was crossed or the solver failed (exit 4)
  kVerification,  ///< a verification or comparison failed (exit 5)
  kResources,     ///< memory or disk ran out (exit 6)
  kStoppedEarly,  ///< stopped with a checkpoint: SIGTERM, SIGUSR1, --max-wall (exit 75)
  kInterrupted,   ///< interrupted with a checkpoint: Ctrl-C (exit 130)
};

/// A failure as a value: what is wrong, where, and what would be right.
struct Error {
  ErrorKind kind = ErrorKind::kInternal;
  std::string message;
  std::string help;
};

/// Either a value or an error; the caller must look.
template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(E error) : content_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool ok() const noexcept { return content_.index() == 0; }
  explicit operator bool() const noexcept { return ok(); }

  [[nodiscard]] T& value() & { return std::get<0>(content_); }
  [[nodiscard]] const T& value() const& { return std::get<0>(content_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(content_)); }
  [[nodiscard]] E& error() & { return std::get<1>(content_); }
  [[nodiscard]] const E& error() const& { return std::get<1>(content_); }
  [[nodiscard]] E&& error() && { return std::get<1>(std::move(content_)); }

  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  std::variant<T, E> content_;
};

/// Success without a value, or an error.
template <class E>
class [[nodiscard]] Result<void, E> {
 public:
  Result() = default;
  Result(E error) : error_(std::move(error)) {}

  [[nodiscard]] bool ok() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return ok(); }
  [[nodiscard]] E& error() & { return *error_; }
  [[nodiscard]] const E& error() const& { return *error_; }
  [[nodiscard]] E&& error() && { return *std::move(error_); }

 private:
  std::optional<E> error_;
};

using Status = Result<void, Error>;

}  // namespace morula

/// Evaluate an expression of Result type; return its error from the enclosing function, if any.
#define MORULA_TRY(expression)                                                                                       \
  do {                                                                                                               \
    if (auto morula_try_result = (expression); !morula_try_result.ok()) return std::move(morula_try_result).error(); \
  } while (false)

#define MORULA_TRY_CONCAT_(a, b) a##b
#define MORULA_TRY_NAME_(a, b) MORULA_TRY_CONCAT_(a, b)
/// `MORULA_TRY_ASSIGN(auto mesh, read_stl(path));` declares `mesh` or returns the error.
#define MORULA_TRY_ASSIGN(declaration, expression)                                                                            \
  auto MORULA_TRY_NAME_(morula_result_, __LINE__) = (expression);                                                             \
  if (!MORULA_TRY_NAME_(morula_result_, __LINE__).ok()) return std::move(MORULA_TRY_NAME_(morula_result_, __LINE__)).error(); \
  declaration = std::move(MORULA_TRY_NAME_(morula_result_, __LINE__)).value()

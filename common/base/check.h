#pragma once

#include <cstdlib>
#include <sstream>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

/// Programming errors stop the process; errors of people, files and networks are absl::Status.
///
///   ONESEA_CHECK(a.size() == b.size()) << "field " << name;
///   ONESEA_RETURN_IF_ERROR(ValidateRecipe(recipe));
///   ONESEA_ASSIGN_OR_RETURN(const Recipe recipe, Decode(bytes));
///
/// Checks stay on in release builds.

namespace onesea::internal {

class CheckFailure {
 public:
  CheckFailure(const char* file, int line, const char* condition);
  [[noreturn]] ~CheckFailure();
  std::ostream& stream() { return stream_; }

 private:
  std::ostringstream stream_;
};

// Lets the macro be an expression of type void whether or not a message follows.
struct Voidify {
  void operator&(std::ostream&) const {}
};

}  // namespace onesea::internal

#define ONESEA_CHECK(condition)                 \
  (condition) ? (void)0                         \
              : ::onesea::internal::Voidify() & \
                    ::onesea::internal::CheckFailure(__FILE__, __LINE__, #condition).stream()

#define ONESEA_CONCAT_INNER(a, b) a##b
#define ONESEA_CONCAT(a, b) ONESEA_CONCAT_INNER(a, b)

#define ONESEA_RETURN_IF_ERROR(expression)                                                      \
  do {                                                                                          \
    if (::absl::Status onesea_status = (expression); !onesea_status.ok()) return onesea_status; \
  } while (false)

#define ONESEA_ASSIGN_OR_RETURN(declaration, expression)            \
  auto ONESEA_CONCAT(onesea_or_, __LINE__) = (expression);          \
  if (!ONESEA_CONCAT(onesea_or_, __LINE__).ok())                    \
    return std::move(ONESEA_CONCAT(onesea_or_, __LINE__)).status(); \
  declaration = std::move(ONESEA_CONCAT(onesea_or_, __LINE__)).value()
